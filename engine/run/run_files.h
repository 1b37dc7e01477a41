#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/io/chain_csv.h"
#include "engine/material/parameter.h"
#include "engine/run/draw.h"

namespace patina {

struct TransitionInfo;

// The files of a run directory.

std::filesystem::path manifest_file(const std::filesystem::path& directory);  ///< run.json
std::filesystem::path photo_file(const std::filesystem::path& directory);     ///< photo.png
std::filesystem::path lock_file(const std::filesystem::path& directory);      ///< writer.lock
std::filesystem::path chain_file(const std::filesystem::path& directory,
                                 int chain);  ///< chain-K.csv, K = chain + 1

/// The parameter columns of a chain file: continuous parameters, then discrete ones.
std::vector<std::string> column_names(const ParameterTable& table);

/// A draw as a row, and what else is known of the transition that made it.
ChainCsvRow to_row(const Draw& draw, const TransitionInfo& info);

/// The way back. @throws UserError for a discrete level that the table does not have
Draw to_draw(const ChainCsvReader::Row& row, const ParameterTable& table, int chain, std::int64_t iteration);

}  // namespace patina
