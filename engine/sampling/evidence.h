#pragma once

#include <Eigen/Core>

#include <vector>

#include "engine/sampling/chain_state.h"

namespace patina {

// For targets in coordinates in which the prior is N(0, I) and all levels are equally likely, and whose log
// density is that of the prior without its constants, -|x|^2 / 2, plus a log likelihood. The evidence is the
// likelihood's mean over the prior.

/// The logarithm of an evidence, nats.
struct LogEvidence {
  double value = 0;
  double error = 0;  ///< Monte Carlo standard deviation; NaN where there is none to give
};

/// A place that a search ended in, and the covariance of the normal approximation there.
struct NormalBasin {
  ChainState mode;
  Eigen::MatrixXd covariance;
};

/// Laplace's approximation (Tierney & Kadane 1986), summed over basins that do not overlap: each is worth its
/// height times the volume of its covariance over that of the prior, over the number of tables of levels that
/// it shares the prior with. Exact for a Gaussian likelihood; blind to what no search found, and to skewness.
/// @param levels  of each discrete coordinate, as LogDensity::discrete_levels() has them
/// @return        in nats; -infinity without basins
double laplace_log_evidence(const std::vector<NormalBasin>& basins, const std::vector<int>& levels);

/// log(sum(exp(terms))) without overflow; -infinity for none.
double log_sum_exp(const std::vector<double>& terms);

}  // namespace patina
