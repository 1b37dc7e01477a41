#pragma once

#include <functional>

#include "engine/sampling/optimizer.h"
#include "engine/sampling/rng.h"

namespace patina {

struct EvolutionSettings {
  double spread = 0.8;         ///< sd of the first generation, in every continuous coordinate
  Eigen::MatrixXd shape = {};  ///< covariance of its steps, in units of spread^2; empty: identity
  int population = 24;         ///< evaluations, of the value alone, a generation
  int generations = 100;       ///< at most
  double narrow = 0.01;        ///< ends early when a generation is narrower in every direction
  int threads = 1;             ///< at a time; the result is the same
  std::function<void()> enter_thread = {};  ///< called first on each of those threads; may be empty
  std::function<bool()> stop_requested = {};
  std::function<void(const OptimizerResult& best)> evolved = {};  ///< called after each generation
};

/// Climbs a density that is rugged, or has no gradient along some coordinates, by the covariance matrix
/// adaptation evolution strategy: each generation is drawn from a normal distribution whose mean, size and
/// shape follow the better half of the one before (Hansen 2016, "The CMA Evolution Strategy: A Tutorial",
/// arXiv 1604.00772, figure 6 with positive weights). What is narrower than a generation is averaged over.
/// Discrete coordinates stay.
/// @return the best position that was met, its evaluation without gradient
OptimizerResult evolve(const LogDensity& target, const Position& start, Rng& rng,
                       const EvolutionSettings& settings);

}  // namespace patina
