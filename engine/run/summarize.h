#pragma once

#include <string>
#include <vector>

#include "engine/material/parameter.h"
#include "engine/run/draw.h"

namespace patina {

/// One row of `patina-cli summarize`: a parameter, a discrete parameter (as level index) or lp.
struct QuantitySummary {
  std::string name;
  double mean = 0, sd = 0;
  double q5 = 0, q25 = 0, q50 = 0, q75 = 0, q95 = 0;
  double mcse_mean = 0, mcse_sd = 0;
  double bulk_ess = 0, tail_ess = 0, rhat = 0;
  double sd_over_prior_sd = 0;  ///< above 0.9: not identified by this photo; NaN for lp and discrete ones
};

struct ChainSummary {
  int chain = 0;
  std::int64_t draws = 0;
  double acceptance = 0;
  std::int64_t divergences = 0;
  double ebfmi = 0;
};

struct RunSummary {
  std::vector<QuantitySummary> quantities;  ///< lp first, then the table's order
  std::vector<ChainSummary> chains;
};

/// Summarises the draws after warm-up; chains are cut to the shortest.
RunSummary summarize_draws(const ParameterTable& table, const std::vector<Draw>& draws);

}  // namespace patina
