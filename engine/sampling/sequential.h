#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/sampling/evidence.h"
#include "engine/sampling/kernel.h"

namespace patina {

struct SequentialSettings {
  int islands = 4;     ///< populations that do not mix: how far they disagree is the error
  int particles = 64;  ///< of each
  /// Particles make transitions on a rung until they have forgotten where they stood: until that correlation,
  /// on the average over directions, has fallen to this. Where they do not forget, evidences are too low and
  /// their error does not tell.
  double correlation = 0.2;
  int most_moves = 60;  ///< transitions of a particle on a rung, at most
  /// A rung ends where the effective share of the weighted particles has fallen to this.
  double effective_share = 0.5;
  std::uint64_t seed = 1;
  int threads = 1;                          ///< particles at a time; the result is the same
  std::function<void()> enter_thread = {};  ///< called first on each of those threads; may be empty
  /// Called after each rung with the inverse temperature reached; who breaks off throws.
  std::function<void(double beta)> reached = {};
};

struct SequentialResult {
  LogEvidence evidence;
  std::vector<ChainState> particles;  ///< draws of the target, all islands
  std::vector<double> log_weights;    ///< of each, its island's share of the evidence; largest 0
  std::vector<double> betas;          ///< the ladder, from 0 to 1
  double worst_correlation = 0;       ///< that particles were left with on a rung
  long transitions = 0;               ///< of all particles together
};

/// Sequential Monte Carlo from prior to posterior (Del Moral, Doucet, Jasra 2006, "Sequential Monte Carlo
/// samplers", JRSSB 68:411; adaptation as in Dai, Heng, Jacob, Whiteley 2022): draws of the prior are
/// weighted by a power of the likelihood, resampled and moved, rung by rung, the next power found by the
/// effective share. Finds modes and levels in proportion to their weight as far as there are particles for
/// them; each island's evidence is unbiased but for what it takes from the common ladder and metric.
/// @param target  see evidence.h
/// @param kernel  of the tempered densities of target
/// @throws std::invalid_argument where no draw of the prior has a density
SequentialResult sample_sequentially(const LogDensity& target, const Kernel& kernel,
                                     const SequentialSettings& settings);

}  // namespace patina
