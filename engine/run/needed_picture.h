#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/image.h"
#include "engine/run/draw.h"
#include "engine/run/run_settings.h"

namespace patina {

/// A cheaper look at the photo, of fewer pixels or fewer levels of the network, and whether its posterior is
/// that of the run.
struct CheaperPicture {
  int resolution = 0;
  std::string summary;
  double times_as_fast = 1;  ///< one evaluation; medians
  /// The largest difference of any continuous parameter's posterior, to first order (reweighting.h): of its
  /// mean, in posterior sds, or of the logarithm of its sd.
  std::string differs_most;  ///< "mean of rough"
  double difference = 0, error = 0;
  bool agrees = false;  ///< no difference is above kTolerance by more than chance might hide
};

/// How much of the picture a photo needs.
struct NeededPicture {
  std::vector<CheaperPicture> tried;
  /// Of `tried`, the one with the fewest pixels, then levels, that agrees; none: all of the picture is
  /// needed.
  const CheaperPicture* cheapest() const;
  std::string sentence() const;

  int resolution = 0;   ///< of the run
  std::string summary;  ///< of the run
};

/// Which difference of two posteriors is none: of a mean in sds, of the logarithm of an sd.
constexpr double kTolerance = 0.3;
constexpr int kUsualPairs = 64;

/// Evaluates the log density of some draws of a run once more with ever fewer pixels, as long as that leaves
/// the posterior what it is, and then with ever fewer levels of the network.
/// @param draws     of the run, warm-up may be among them
/// @param pairs     how many draws to evaluate
/// @param progress  called with what is being tried
/// @throws UserError for a run of calibrated errors, whose summaries were learnt at its resolution; for fewer
///                   draws than pairs; for draws whose densities are not what the settings mean now
NeededPicture needed_picture(const RunSettings& settings, const Image& photo, const std::vector<Draw>& draws,
                             int pairs = kUsualPairs,
                             const std::function<void(const std::string& doing)>& progress = {});

}  // namespace patina
