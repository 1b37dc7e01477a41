#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "engine/posterior/photo_fit.h"
#include "engine/posterior/posterior.h"
#include "engine/run/run_settings.h"
#include "engine/run/run_shared.h"
#include "engine/sampling/chain_state.h"
#include "engine/sampling/metric.h"

namespace patina {

class Archive;
class RegressedLikelihood;

/// A likelihood that a run has learnt from simulated photos, and how its photo compares with them.
struct CalibratedErrors {
  std::shared_ptr<const RegressedLikelihood> likelihood;
  PhotoFit fit;
};

/// @throws ArchiveError
void serialise(Archive& archive, CalibratedErrors& errors);

/// Whether they can be of a posterior: sizes, numbers that are finite.
bool fits(const CalibratedErrors& errors, const Posterior& posterior);

/// Calibrated errors with the posterior's mode and Laplace's covariance under them.
struct CalibratedMode {
  CalibratedErrors errors;
  ChainState mode;
  std::shared_ptr<const Metric> laplace;
};

/// On all processors.
/// @param seed       of what is simulated   @param simulated  called after each photo, from any thread; what
///                   it throws ends the simulations
/// @param match      searches for the best match by hand-set errors, for a photo that is not like simulated
///                   ones
CalibratedMode learn_errors(const Posterior& posterior, const Image& photo, const Capture& capture,
                            std::uint64_t seed, const std::function<void()>& simulated,
                            const std::function<Position()>& match);

/// learn_errors() of a run, whose status it keeps up to date.
/// @throws RunStopped
CalibratedMode calibrate_errors(const Posterior& posterior, const Image& photo, const RunSettings& settings,
                                RunShared& shared, const std::function<Position()>& match);

}  // namespace patina
