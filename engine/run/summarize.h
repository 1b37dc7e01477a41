#pragma once

#include <string>
#include <vector>

#include "engine/material/parameter.h"
#include "engine/run/alarm.h"
#include "engine/run/draw.h"

namespace patina {

struct ChainMean {
  int chain = 0;
  double mean = 0;
};

/// One row of `patina-cli summarize`: a parameter, a discrete parameter (as level index) or lp.
struct QuantitySummary {
  std::string name;
  double mean = 0, sd = 0;
  double q5 = 0, q25 = 0, q50 = 0, q75 = 0, q95 = 0;
  double mcse_mean = 0, mcse_sd = 0;
  double bulk_ess = 0, tail_ess = 0, rhat = 0;
  std::vector<ChainMean> chain_means;  ///< of the chains that have draws
  double sd_over_prior_sd = 0;  ///< above 0.9: not identified by this photo; NaN for lp and discrete ones
};

/// A direction in which the draws spread most, of continuous parameters in sampling coordinates (where the
/// prior is N(0, I)), each over its posterior sd.
struct DirectionSummary {
  std::string name;              ///< its largest loadings, as "height - 0.8 power"
  std::vector<double> loadings;  ///< in the table's order, of length 1
  double share = 0;              ///< of the variance
  double bulk_ess = 0, tail_ess = 0, rhat = 0;
};

struct ChainSummary {
  int chain = 0;
  std::int64_t draws = 0;
  double acceptance = 0;
  std::int64_t divergences = 0;
  bool has_trajectories = false;  ///< of hmc or nuts
  /// Of the energies of hmc's and nuts' trajectories, other moves left out; of -lp for the other kernels.
  double ebfmi = 0;
};

struct RunSummary {
  std::vector<QuantitySummary> quantities;   ///< lp first, then the table's order
  std::vector<DirectionSummary> directions;  ///< widest first, at most three
  std::vector<ChainSummary> chains;
  Alarms alarms;  ///< see draw_alarms()
};

/// Summarises the draws after warm-up; chains are cut to the shortest.
RunSummary summarize_draws(const ParameterTable& table, const std::vector<Draw>& draws);

}  // namespace patina
