#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "engine/comparison/rank_materials.h"
#include "engine/image.h"
#include "engine/posterior/posterior.h"
#include "engine/run/run_control.h"
#include "engine/sampling/evidence.h"

namespace patina {

/// Flash and vignetting are the camera's, not the material's: in a ranking all materials have the same priors
/// for them, wide ones, where a fit has those of the material's file, which mean a camera at 25 cm. The
/// flash's is scaled with the square of the camera's distance, the vignetting's with the distance, so that
/// what the camera sees has the same prior whatever the size.
std::map<std::string, TruncatedNormal> camera_priors(const std::string& material, const Capture& capture);

/// One material's posterior for the photo that a ranking is about, and what is known of its evidence.
class MaterialEvidence {
 public:
  /// @param photo  outlives this   @param glance  log probability before the search   @throws UserError
  MaterialEvidence(const std::string& material, const RankSettings& settings, const Image& photo,
                   double glance);

  /// A search from draws of the prior, coarse first, and Laplace's approximation in the basins that it ends
  /// in.
  /// @param progress  with the share done   @throws RunStopped
  void search(int threads, RunControl& control, const std::function<void(double)>& progress);

  /// Sequential Monte Carlo. @throws RunStopped
  void measure(int threads, RunControl& control, const std::function<void(double)>& progress);

  /// How well each quarter of the photo is foretold by the opposite one: a climb from the best match, jagged
  /// coordinates held, that sees no other quarter. @throws RunStopped
  void foretell(int threads, RunControl& control, const std::function<void(double)>& progress);

  /// How far renders with other irregularities are from that of the best match, on the average.
  void compare_samples();

  RankedMaterial ranked() const;

 private:
  RankSettings settings_;
  const Image& photo_;
  Posterior coarse_, posterior_;
  double glance_;
  LogEvidence evidence_;
  Position best_;                        ///< the prior's means before a search
  double expected_misfit_, misfit_ = 0;  ///< half chi-squares
  std::optional<double> misfit_of_another_sample_;
  std::vector<double> quarters_;
  double seconds_ = 0;
};

}  // namespace patina
