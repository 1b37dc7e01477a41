#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/sampling/metric.h"
#include "engine/sampling/optimizer.h"
#include "engine/sampling/rng.h"

namespace patina {

struct MapSearchSettings {
  /// Candidates N(0, I), discrete levels uniform, on the coarsest target; none where populations evolve.
  int prior_draws = 64;
  std::vector<Position> guesses =
      {};               ///< the best three are climbed from as well, and have a finalist of theirs
  int descents = 8;     ///< best candidates that are climbed from on the coarsest target
  int finalists = 2;    ///< best of those that are climbed from on every finer target
  int evolutions = 4;   ///< of targets with jagged coordinates, on the coarsest, one from a guess
  int generations = 5;  ///< of each for every continuous coordinate; half as many, small ones, of a finalist
  int coarse_iterations = 40;
  int fine_iterations = 40;
  int threads =
      1;  ///< candidates, and climbs from different starts, run at the same time; the result is the same
  std::function<void()> enter_thread;    ///< called first on each thread of the search; may be empty
  std::function<bool()> stop_requested;  ///< asked from those threads
  /// Called from those threads, one at a time.
  std::function<void(double fraction, const Position& best, double log_density)> progress;
};

struct MapSearchResult {
  OptimizerResult best;                 ///< on the finest target
  std::vector<OptimizerResult> basins;  ///< all finalists, best first
};

/// A global search for the posterior's mode, cheap first: targets are the same posterior from coarse to fine.
/// Discrete coordinates are swept (every level of each, others held) around each finalist. Where there are
/// jagged coordinates, which no climb moves, populations are evolved by values alone (evolution.h), on the
/// coarsest target and about each finalist on the next, and the climbs begin at what they find.
MapSearchResult search_map(const std::vector<const LogDensity*>& targets, Rng& rng,
                           const MapSearchSettings& settings = {});

/// Laplace's approximation at a mode: the inverse of the negative Hessian (central differences of the
/// gradient, symmetrised; along jagged coordinates wide differences of the value), eigenvalues of the Hessian
/// floored at 0.25: a prior N(0, I) alone gives 1.
/// @param threads  at a time; the result is the same   @param enter_thread  called first on each; may be
/// empty
Eigen::MatrixXd laplace_covariance(const LogDensity& target, const Position& mode, int threads = 1,
                                   const std::function<void()>& enter_thread = {});

}  // namespace patina
