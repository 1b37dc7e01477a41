#pragma once

#include "engine/diagnostics/convergence.h"

namespace patina {

/// What would become of a quantity if its draws came from another distribution.
struct Reweighting {
  double mean_shift = 0;  ///< of the mean, in standard deviations
  double log_spread = 0;  ///< logarithm of the other sd over this one
  // Monte Carlo standard errors.
  double mean_error = 0;
  double spread_error = 0;
};

/// To first order in the logarithm of the ratio of both densities: d E[f] = Cov(f, log ratio), the derivative
/// of an expectation in an exponential family (Wainwright and Jordan 2008, "Graphical Models, Exponential
/// Families, and Variational Inference", proposition 3.1). Exact for the mean of a normal distribution and a
/// log ratio that is linear; beyond a shift of about 1 it tells no more than that there is one.
/// @param draws      of one quantity
/// @param log_ratio  of the same draws: log of the other density over theirs, up to a constant
/// @param effective  how many independent draws they are worth
Reweighting reweight(const Eigen::Ref<const Eigen::VectorXd>& draws,
                     const Eigen::Ref<const Eigen::VectorXd>& log_ratio, double effective);

}  // namespace patina
