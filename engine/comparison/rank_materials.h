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

struct RunSettings;

/// What a ranking of materials is asked for.
struct RankSettings {
  std::vector<std::string> materials;  ///< by name; empty: all
  Capture capture;
  int resolution =
      128;  ///< pixels a side at which renders are compared with the photo: at 64 no grain is left
  std::string summary = "gram";   ///< the same for all, since evidences compare only on the same data
  std::filesystem::path network;  ///< empty: the bundled one
  bool glance = false;            ///< only what a trained network says, in a second (material_glance.h)
  int finalists = 3;              ///< so many of the best are measured again, with an error; 0: none
  int particles = 32;             ///< of each of the four islands that measure with
  int threads = 0;                ///< 0: as many as the machine has
  std::uint64_t seed = 1;
  std::uint64_t z_seed = 1;
};

/// How well one material explains the photo.
struct RankedMaterial {
  std::string material;
  int parameters = 0;  ///< free ones, discrete included: of two that explain alike, fewer are preferred
  /// Natural logarithm of the likelihood's mean over the prior, constants that all materials share dropped.
  double log_evidence = 0;
  /// Its Monte Carlo standard deviation; none of the first cut's (Laplace), nor where particles hardly moved.
  std::optional<double> error;
  /// Log likelihoods of the photo's four quarters, each at the place that explains the opposite one best:
  /// what a material that fits by chance does not foresee. Empty of a glance, and where quarters have too few
  /// pixels for the summary.
  std::vector<double> quarters;
  /// Log probability that a network gives it at a glance (material_glance.h), which sees structure and
  /// neither light nor colour, where the evidence, its errors being wide, is mostly of these. 0 where there
  /// was no glance beside the search, and of a glance alone, whose log evidence it is.
  double glance = 0;
  double probability = 0;  ///< among the materials compared, all equally likely beforehand
  ParameterValues match;   ///< the best that was found
  /// How far that is off the photo, over what the error model allows a material that fits: about 1 or less of
  /// one that does, above kPoorMatch of one that does not.
  /// None of a glance.
  std::optional<double> misfit;
  /// How far another sample of the same surface would be off, other irregularities at the same parameters:
  /// what no search can remove. Of the first material alone.
  std::optional<double> misfit_of_another_sample;
  double seconds = 0;  ///< of the wall clock
};

/// All materials that were compared, the preferred first.
struct MaterialRanking {
  std::vector<RankedMaterial> materials;
  std::string summary;   ///< that all were compared by
  std::string sentence;  ///< the result in plain words
};

constexpr int kLeastRankResolution = 32;
constexpr double kPoorMatch = 2;

/// What a run that is to choose its own material asks for: a glance, which was right more often than searches
/// that take minutes (resources/compare), or, with materials that it does not know, the first cut alone.
RankSettings first_cut(const RunSettings& settings, const Capture& capture);

/// Ranks materials for a photo: every one by a coarse search and Laplace's approximation, which what is seen
/// at a glance precedes as prior odds, and by how well it foretells quarters of the photo, then the best few
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
