#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

#include "engine/chart/problem.h"

namespace patina {

/// When a trial ends, and what its chance is.
struct TrialPlan {
  std::uint64_t seed = 1;
  int draws = 0;       ///< of each chain, after warm-up
  double seconds = 0;  ///< from the start, search and warm-up included; 0: no limit
  int threads = 1;     ///< of the search; chains have one each
};

/// The best match so far, at a time.
struct BestMatch {
  double seconds = 0;  ///< since the start
  Eigen::VectorXd values;
};

/// Draws of one chain after warm-up.
struct TrialChain {
  std::vector<double> seconds;          ///< of each draw, since the start
  std::vector<Eigen::VectorXd> values;  ///< as ChartProblem::values() has them
  std::vector<Eigen::VectorXi> levels;
};

/// Draws of each quantity, draws x chains, in its own units.
struct QuantityDraws {
  std::vector<Eigen::MatrixXd> continuous, discrete;

  Eigen::Index draws() const;  ///< of each chain
};

/// What came of a setting, from the start as a run has it: search for the mode, start, warm-up, draws.
struct Trial {
  std::vector<BestMatch> search;
  std::vector<TrialChain> chains;
  double seconds = 0, search_seconds = 0, warmup_seconds = 0;  ///< of wall time; the first is all of it
  double processor_seconds = 0;                                ///< of all threads
  long evaluations = 0, search_evaluations = 0, warmup_evaluations = 0;  ///< likewise
  long value_evaluations = 0;  ///< those of all that asked for no gradient

  QuantityDraws draws() const;  ///< chains cut to the shortest
};

/// Tries a setting. Without a limit of time the draws and counts depend on setting and seed alone.
Trial run_trial(const ChartProblem& problem, const ChartSetting& setting, const TrialPlan& plan);

}  // namespace patina
