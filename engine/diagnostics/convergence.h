#pragma once

#include <Eigen/Core>

namespace patina {

/// Draws of one quantity, in its own units: a row per iteration, a column per chain, warm-up left out.
using ChainDraws = Eigen::Ref<const Eigen::MatrixXd>;

// Definitions: Vehtari, Gelman, Simpson, Carpenter, Buerkner 2021 (Bayesian Analysis 16:667), as in Stan,
// R posterior and ArviZ. All return NaN where undefined (fewer than four draws a chain, a draw that is not
// finite); a constant quantity has R-hat NaN, an ESS of its number of draws and an MCSE of 0. None throws.

/// Rank-normalised, folded and split; the larger of bulk and tail. 1 at convergence, alarm above 1.01.
double split_rhat(ChainDraws draws);

/// Effective number of draws for the centre: of the mean of the rank-normalised draws.
double bulk_ess(ChainDraws draws);

/// Effective number of draws for the tails: the smaller of the 5 % and 95 % quantiles'.
double tail_ess(ChainDraws draws);

/// Effective number of draws for the mean, without rank normalisation.
double mean_ess(ChainDraws draws);

/// Monte Carlo standard error of the mean, in the quantity's units.
double mcse_mean(ChainDraws draws);

/// Monte Carlo standard error of the standard deviation (by the ESS of the squared deviations, as R
/// posterior).
double mcse_sd(ChainDraws draws);

/// Monte Carlo standard error of a quantile. @param probability  in [0, 1]
double mcse_quantile(ChainDraws draws, double probability);

/// Quantile of type 7 (linear between order statistics), chains pooled. @param probability  in [0, 1], else
/// NaN
double quantile(ChainDraws draws, double probability);

/// Of all draws, chains pooled, with the divisor n - 1.
double standard_deviation(ChainDraws draws);

/// Estimated Bayesian fraction of missing information (Betancourt 2016): the mean squared change of the
/// energy over its variance; 2 for independent energies, below 0.3 is a warning. @param energy  of one chain
double ebfmi(const Eigen::Ref<const Eigen::VectorXd>& energy);

}  // namespace patina
