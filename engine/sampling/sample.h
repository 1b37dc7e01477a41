#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/sampling/kernel.h"
#include "engine/sampling/warmup.h"

namespace patina {

struct SampleSettings {
  int chains = 4;
  int warmup = 1000;  ///< of each chain, left out of the sample
  int draws = 1000;   ///< of each chain
  std::uint64_t seed = 1;
  MetricKind metric = MetricKind::dense;
  double metric_worth = 0;  ///< of the metric that warm-up begins with, see pool()
  int noise_repeats = 20;   ///< evaluations of one place after warm-up, see value_noise(); 0: none
  int threads = 1;          ///< chains at a time; the sample is the same
  // For who watches or breaks off (by throwing); all but the last see chains and cannot change them.
  std::function<void()> enter_thread = {};                    ///< called first on each thread of the chains
  std::function<void(const KernelSettings&)> warmed_up = {};  ///< called once, when all chains have
  /// Called after each iteration of warm-up, and after each draw, from the chains' threads at the same time.
  std::function<void(int chain, const ChainState&)> warmed = {}, drew = {};
  /// The kernel of the draws, asked for once all chains are warm; empty: warm-up's. It outlives the chains.
  std::function<const Kernel&()> kernel_of_draws = {};
};

/// What several chains drew after warm-up. A matrix has a row per draw and a column per chain, as the
/// diagnostics (engine/diagnostics/convergence.h) take it.
struct Sample {
  std::vector<Eigen::MatrixXd> coordinates;  ///< of each continuous coordinate
  std::vector<Eigen::MatrixXd> levels;       ///< of each discrete coordinate
  Eigen::MatrixXd log_density;
  Eigen::MatrixXd energy;          ///< see TransitionInfo
  std::vector<double> acceptance;  ///< mean acceptance probability of each chain's continuous moves
  KernelSettings frozen;           ///< what warm-up ended with
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> divergent;  ///< of each transition
  int divergences = 0;
  double noise = 0;  ///< nats: sd of the log density of one place, where the first chain was after warm-up
  long evaluations = 0;  ///< after warm-up
};

using Start = std::function<Position(Rng&)>;

/// Warms up several chains of a kernel, which pool what they learn, and draws: a whole run in memory, for any
/// log density. Depends on the settings alone, not on threads.
/// @param start   where a chain begins; called once per chain with the chain's generator, from its thread
/// @param metric  to begin warm-up with
Sample sample(const LogDensity& target, const Kernel& kernel, const SampleSettings& settings,
              const Start& start, const Metric& metric);

/// The same from N(0, I) starts, levels uniform, in the identity metric.
Sample sample(const LogDensity& target, const Kernel& kernel, const SampleSettings& settings = {});

}  // namespace patina
