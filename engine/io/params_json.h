#pragma once

#include <filesystem>
#include <string>

#include "engine/material/parameter.h"

namespace patina {

/// Parameter values as JSON: {"light": 1500.0, ..., "cells": 2}; all of a table's names, discrete ones as
/// indices.
std::string params_to_json(const ParameterTable& table, const ParameterValues& values);

/// Reads a params file over the defaults: names not in the file keep their value.
/// @throws UserError for a file that is not such JSON, an unknown name, a value that is not a number or out
/// of range
ParameterValues read_params(const std::filesystem::path& file, const ParameterTable& table,
                            ParameterValues defaults);

/// Sets one value. @throws UserError for an unknown name or a value out of range
void set_parameter(const ParameterTable& table, const std::string& name, double value,
                   ParameterValues& values);

}  // namespace patina
