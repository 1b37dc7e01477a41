#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/io/photo.h"
#include "engine/run/run_settings.h"

namespace patina {

constexpr int kMostChains = 64;
constexpr int kMostRungs = 64;
constexpr int kMostIterations = 10'000'000;
constexpr int kLeastResolution = 16;
constexpr int kMostResolution = 4096;

/// @throws UserError unless it is in [kLeastResolution, kMostResolution]
void check_resolution(int resolution);

/// @throws UserError unless its lengths are from 0.1 to 10000 cm
void check_capture(const Capture& capture);

/// What errors can be in force, and what can be asked for: "auto", too.
std::vector<std::string> error_names();
std::vector<std::string> asked_error_names();

/// Counts, geometry and kernel; what the posterior's construction checks is left to it.
/// @throws UserError for the first setting that cannot be
void check_settings(const RunSettings& settings, const Photo& photo);

/// Makes a folder and those above it, unless it exists. @throws UserError
void make_folder(const std::filesystem::path& folder);

/// @throws UserError if the directory holds a run already
void check_holds_no_run(const std::filesystem::path& directory);

}  // namespace patina
