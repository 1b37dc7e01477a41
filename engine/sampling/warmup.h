#pragma once

#include <Eigen/Core>

#include <memory>
#include <vector>

#include "engine/sampling/chain_state.h"
#include "engine/sampling/rng.h"
#include "engine/sampling/step_size_adaptation.h"

namespace patina {

/// One stretch of warm-up. At its end, if adapts_metric, all chains meet and share a new metric.
struct WarmupWindow {
  int begin = 0;
  int end = 0;
  bool adapts_metric = false;
};

/// Stan's shape: a first window for the step size alone, doubling windows that also adapt the metric, a last
/// one for the step size. Covers [0, iterations) without gaps; below 20 iterations one window for the step
/// size alone, for 0 none. As in the Stan reference manual, section "Automatic parameter tuning".
std::vector<WarmupWindow> warmup_schedule(int iterations);

/// What one chain brings to the end of a window.
struct WindowReport {
  Eigen::MatrixXd positions;  ///< dimension x transitions
  double step_size = 0;       ///< averaged over the window
};

/// A step size to begin warm-up with (Hoffman & Gelman 2014, algorithm 4): doubles or halves
/// settings.step_size until the acceptance probability of one leapfrog step crosses 0.8. Takes a handful of
/// evaluations.
/// @param state  of finite log density
double initial_step_size(const LogDensity& target, const KernelSettings& settings, const ChainState& state,
                         Rng& rng);

/// One chain's part of a warm-up: sees (state, info) only, yields settings. Used on that chain's thread.
class ChainWarmup {
 public:
  /// @param target_acceptance  of the kernel; 0: there is no step size to adapt
  ChainWarmup(KernelSettings start, double target_acceptance);

  const KernelSettings& settings() const { return settings_; }

  /// Once after each transition. Step-size adaptation looks at continuous moves only.
  void observe(const ChainState& state, const TransitionInfo& info);

  /// At the end of every window. Forgets the positions, so that the next report has those of its window
  /// alone.
  WindowReport report();

  /// Goes on with what all chains pooled: from its step size the search starts anew.
  void adopt(const KernelSettings& pooled);

  /// The settings to sample with: the averaged step size, the last metric.
  KernelSettings frozen() const;

 private:
  KernelSettings settings_;
  StepSizeAdaptation step_size_;
  bool adapts_step_size_;
  std::vector<Eigen::VectorXd> positions_;
};

/// What all chains go on with after a window: the geometric mean of their step sizes, since each has seen few
/// moves alone, and after a window that adapts it the metric of their pooled covariance, else the metric as
/// it was.
KernelSettings pooled(const std::vector<WindowReport>& chains, bool adapts_metric,
                      std::shared_ptr<const Metric> metric);

/// Covariance pooled over chains: within-chain covariances averaged (between-chain spread of unconverged
/// chains left out), shrunk as Stan does: n/(n+5) S + 1e-3 5/(n+5) I. @param chains one matrix per chain,
/// a position per column
Eigen::MatrixXd pooled_covariance(const std::vector<Eigen::MatrixXd>& chains);

}  // namespace patina
