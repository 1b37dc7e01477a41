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
/// one for the step size; but a last doubling window with room for two is cut in two, the better to learn a
/// bent ridge, along which chains walk only as far as the map before lets them. Covers [0, iterations)
/// without gaps; below 20 iterations one window for the step size alone, for 0 none. As in the Stan reference
/// manual, section "Automatic parameter tuning".
std::vector<WarmupWindow> warmup_schedule(int iterations);

/// Whether chains of that many iterations of warm-up meet at the end of the window: to share a metric, or the
/// step size that they end with.
bool chains_meet(const WarmupWindow& window, int iterations);

/// A step size to begin warm-up with (Hoffman & Gelman 2014, algorithm 4): doubles or halves
/// settings.step_size until the acceptance probability of one leapfrog step crosses 0.8. Takes a handful of
/// evaluations.
/// @param state  of finite log density
double initial_step_size(const LogDensity& target, const KernelSettings& settings, ChainState state,
                         Rng& rng);

/// What one chain brings to the end of a window.
struct WindowResult {
  Eigen::MatrixXd positions;             ///< dimension x transitions
  double step_size = 0;                  ///< averaged over the window, as dual averaging has it
  std::shared_ptr<const Metric> metric;  ///< that the window was run with
  std::shared_ptr<const Straightening> straightening = nullptr;  ///< likewise
};

/// What all chains make of a window: the metric of their pooled covariance (for the curved kind, in the
/// coordinates that a map fitted to the window straightens), and the median of their step
/// sizes (in logs). A window holds few transitions, and one chain's estimate of the step scatters so much
/// that some chains would be frozen far from the acceptance that was asked for; the median is not moved by a
/// chain that is stuck.
///
/// A metric to begin with that is known to be about right, such as Laplace's, is worth more than what slow
/// chains see in a short window: MALA in 23 dimensions, after 300 iterations of warm-up, has seven times the
/// ESS when it is kept in part.
/// @param chains  not empty
/// @param metric_worth  the number of transitions that the window's own metric weighs as much as
/// @param jagged  as LogDensity has them: they take no part in that map
KernelSettings pool(const std::vector<WindowResult>& chains, MetricKind kind, double metric_worth = 0,
                    const std::vector<bool>& jagged = {});

/// One chain's part of a warm-up: sees (state, info) only, yields settings. Used on that chain's thread.
class ChainWarmup {
 public:
  /// @param target_acceptance  of the kernel; 0: there is no step size to adapt
  explicit ChainWarmup(KernelSettings start = {}, double target_acceptance = 0);

  const KernelSettings& settings() const { return settings_; }

  /// Once after each transition. Step-size adaptation looks at continuous moves only.
  void observe(const ChainState& state, const TransitionInfo& info);

  /// To be called at the end of every window, so that positions of a window that does not adapt the metric
  /// are left out of the next.
  WindowResult take_window();

  /// Installs the pooled metric and restarts the step-size search from the pooled step.
  void restart(const KernelSettings& pooled);

  /// Settles on a step size, until the next observation: at the end of warm-up for good.
  void freeze(double step_size) { settings_.step_size = step_size; }

  /// Whether all that it saw are positions of that dimension.
  bool has_dimension(Eigen::Index dimension) const;

  /// All fields; see Archive. Include "engine/sampling/serialise.h" where it is called.
  template <typename Archive>
  void serialise(Archive& archive) {
    archive(settings_, step_size_, adapts_step_size_, positions_);
  }

 private:
  KernelSettings settings_;
  StepSizeAdaptation step_size_;
  bool adapts_step_size_;
  std::vector<Eigen::VectorXd> positions_;
};

/// Covariance pooled over chains: within-chain covariances averaged (between-chain spread of unconverged
/// chains left out), shrunk as Stan does: n/(n+5) S + 1e-3 5/(n+5) I. @param chains one matrix per chain,
/// a position per column
Eigen::MatrixXd pooled_covariance(const std::vector<Eigen::MatrixXd>& chains);

}  // namespace patina
