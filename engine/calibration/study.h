#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "engine/posterior/calibrate.h"
#include "engine/posterior/camera.h"
#include "engine/posterior/irregularity_pool.h"
#include "engine/posterior/posterior.h"

namespace patina {

/// What a calibration study asks.
struct StudySettings {
  PosteriorSettings posterior;   ///< its z_seed is not used: every photo has a run of its own
  std::string errors = "paper";  ///< of error_names()
  CalibrationSettings simulations;
  double error_scale = 1;  ///< times the sd of calibrated errors: others than 1 must be found out
  Camera camera;           ///< that takes the photos, and is thought to
  int chains = 4, warmup = 300, draws = 1000;
  std::uint64_t seed = 1;
};

/// One parameter of one photo, or lp.
struct TruthAndPosterior {
  double place = 0;             ///< of the truth among the draws, see place_among()
  double sd_over_prior_sd = 0;  ///< NaN for lp
  double rhat = 0;              ///< NaN where nothing moved
};

/// What came of one synthetic photo.
struct PhotoOutcome {
  int photo = 0;
  double seconds = 0;                         ///< of one core
  double worst_rhat = 0;                      ///< of lp and all continuous parameters
  double least_ess = 0;                       ///< bulk, likewise
  double distance = 0;                        ///< PhotoFit; NaN for errors that are not calibrated
  double widening = 1;                        ///< likewise
  double simulated = 0;                       ///< photos, the pilot's left out
  std::vector<TruthAndPosterior> quantities;  ///< lp, then the free continuous parameters
};

/// A study of synthetic photos: the truth is a draw of the prior, the photo is taken of it (camera.h) with
/// irregularities that no run knows, and its posterior drawn from with short chains. A photo depends on the
/// settings and its number only. For several threads.
class CalibrationStudy {
 public:
  /// @throws UserError as Posterior does
  CalibrationStudy(const StudySettings& settings, int threads, std::function<void()> enter_thread);

  /// lp, then the free continuous parameters.
  const std::vector<std::string>& quantities() const { return quantities_; }

  PhotoOutcome run(int photo) const;

 private:
  const Pilot& pilot() const;

  StudySettings settings_;
  Posterior blank_;  ///< of no photo: the same prior and coordinates as every photo's
  Guess guess_;      ///< of calibrated errors
  int threads_;
  std::function<void()> enter_thread_;
  std::shared_ptr<IrregularityPool> pool_;  ///< of all but hand-set errors
  mutable std::once_flag pilot_made_;
  mutable std::optional<Pilot> pilot_;  ///< made for the first photo that needs it
  std::vector<std::string> quantities_;
};

}  // namespace patina
