#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/image.h"
#include "engine/material/capture.h"
#include "engine/material/parameter.h"

namespace patina {

/// What a ranking of materials is asked for.
struct RankSettings {
  std::vector<std::string> materials;  ///< by name; empty: all
  Capture capture;
  int resolution = 64;            ///< pixels a side at which renders are compared with the photo
  std::string summary;            ///< the same for all; empty: common_summary()
  std::filesystem::path network;  ///< empty: the bundled one
  int finalists = 3;              ///< so many of the best are measured again, with an error; 0: none
  int threads = 0;                ///< 0: as many as the machine has
  std::uint64_t seed = 1;
  std::uint64_t z_seed = 1;
};

/// How well one material explains the photo.
struct RankedMaterial {
  std::string material;
  int parameters = 0;  ///< free ones, discrete included: of two that explain alike, fewer are preferred
  /// Natural logarithm of the likelihood's mean over the prior, constants that all materials share dropped,
  /// and its Monte Carlo standard deviation; NaN for those that only the first cut has seen (Laplace).
  double log_evidence = 0;
  double error = 0;
  double probability = 0;  ///< among the materials compared, all equally likely beforehand
  ParameterValues match;   ///< the best that was found
  double seconds = 0;      ///< of the wall clock
};

/// All materials that were compared, the preferred first.
struct MaterialRanking {
  std::vector<RankedMaterial> materials;
  std::string summary;   ///< that all were compared by
  std::string sentence;  ///< the result in plain words
};

/// A summary that is blind to none of the materials' ways to differ: all that any of them is compared by, by
/// itself. Evidences compare only on the same data, and a summary of one material's own would let the others
/// win by what it does not see.
std::string common_summary(const std::vector<std::string>& materials);

/// Ranks materials for a photo: every one by a coarse search and Laplace's approximation, then the best few
/// by sequential Monte Carlo (sampling/sequential.h). Safe to call from any thread; takes tens of seconds.
/// @param photo     square, 3 channels, sRGB in [0,1]
/// @param progress  called from this thread and others, one at a time, with the share that is done and what
/// is
///                  being done, in words; may be empty
/// @return          nothing after a stop was requested, within one evaluation
/// @throws UserError for unknown names, sizes and resolutions that cannot be
std::optional<MaterialRanking> rank_materials(
    const Image& photo, const RankSettings& settings,
    const std::function<void(double fraction, const std::string& doing)>& progress = {},
    std::stop_token stop = {});

}  // namespace patina
