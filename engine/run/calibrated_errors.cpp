#include "engine/run/calibrated_errors.h"

#include <atomic>
#include <cmath>
#include <optional>
#include <string>

#include "engine/posterior/calibrate.h"
#include "engine/run/predicted_start.h"
#include "engine/run/threads.h"
#include "engine/sampling/archive.h"

namespace patina {
namespace {

/// Says how many photos have been simulated; how many it takes depends on what they show.
class Progress {
 public:
  explicit Progress(RunShared& shared) : shared_(shared) {}

  void operator()() {
    shared_.control.checkpoint();
    const int made = ++made_;
    if (made % kPhotosAMessage != 0) return;
    shared_.edit_status([&](RunStatus& status) {
      status.message = "learning from simulated photos what irregularities do: " + std::to_string(made) +
                       " so far, a few hundred are usual";
    });
  }

 private:
  static constexpr int kPhotosAMessage = 10;
  RunShared& shared_;
  std::atomic<int> made_{0};
};

}  // namespace

void serialise(Archive& archive, CalibratedErrors& errors) {
  RegressedLikelihood likelihood = errors.likelihood ? *errors.likelihood : RegressedLikelihood();
  archive(likelihood, errors.fit.distance, errors.fit.p, errors.fit.widening, errors.fit.discrepancy);
  errors.likelihood = std::make_shared<const RegressedLikelihood>(std::move(likelihood));
}

bool fits(const CalibratedErrors& errors, const Posterior& posterior) {
  const PhotoFit& fit = errors.fit;
  return errors.likelihood && errors.likelihood->is_of(std::ssize(posterior.informed())) &&
         std::isfinite(fit.distance) && fit.p > 0 && fit.p <= 1 && fit.widening >= 1 &&
         std::isfinite(fit.widening) && (fit.discrepancy == 0 || fit.discrepancy == 1);
}

CalibratedMode learn_errors(const Posterior& posterior, const Image& photo, const Capture& capture,
                            std::uint64_t seed, const std::function<void()>& simulated,
                            const std::function<Position()>& match) {
  const CalibrationSettings amount;
  const auto pool = make_pool(posterior.table(), kSimulatedSeeds);
  const Simulator simulator{.posterior = posterior,
                            .pool = *pool,
                            .camera = {},
                            .seed = seed,
                            .threads = hardware_threads(),
                            .enter_thread = [] { use_tensor_threads(1); },
                            .simulated = simulated,
                            .guess = region_guess(posterior, capture)};
  std::optional<Pilot> pilot;
  const OnDemand on_demand{.pilot = [&]() -> const Pilot& { return pilot.emplace(simulator, amount.pilot); },
                           .match = [&] { return match().continuous; }};
  Calibration found = calibrate(simulator, photo, on_demand, amount);
  CalibratedErrors errors{std::make_shared<const RegressedLikelihood>(std::move(found.likelihood)),
                          found.fit};
  const Posterior calibrated = posterior.with(errors.likelihood);
  const Eigen::Index levels = std::ssize(posterior.discrete_levels());
  const Position mode{found.mode, Eigen::VectorXi::Zero(levels)};
  return {
      std::move(errors), {mode, calibrated.evaluate(mode)}, std::make_shared<const Metric>(found.covariance)};
}

CalibratedMode calibrate_errors(const Posterior& posterior, const Image& photo, const RunSettings& settings,
                                RunShared& shared, const std::function<Position()>& match) {
  Progress progress(shared);
  return learn_errors(
      posterior, photo, settings.capture, settings.seed, [&] { progress(); }, match);
}

}  // namespace patina
