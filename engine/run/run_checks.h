#pragma once

#include <filesystem>

#include "engine/io/photo.h"
#include "engine/posterior/posterior.h"
#include "engine/run/run_settings.h"

namespace patina {

constexpr int kMostChains = 64;
constexpr int kMostIterations = 10'000'000;
constexpr int kLeastResolution = 16;
constexpr int kMostResolution = 4096;

/// @throws UserError unless it is in [kLeastResolution, kMostResolution]
void check_resolution(int resolution);

/// Counts, geometry and kernel; what the posterior's construction checks is left to it.
/// @throws UserError for the first setting that cannot be
void check_settings(const RunSettings& settings, const Photo& photo);

/// The posterior of a run at another resolution.
PosteriorSettings posterior_settings(const RunSettings& settings, int resolution);

/// @throws UserError if nothing is left to infer
void check_free_parameters(const Posterior& posterior);

/// Makes a folder and those above it, unless it exists. @throws UserError
void make_folder(const std::filesystem::path& folder);

/// @throws UserError if the directory holds a run already
void check_holds_no_run(const std::filesystem::path& directory);

}  // namespace patina
