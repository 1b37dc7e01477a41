#pragma once

#include <Eigen/Core>

namespace patina {

/// Draws of one quantity: a row per iteration, a column per chain, warm-up left out.
using ChainDraws = Eigen::Ref<const Eigen::MatrixXd>;

// Definitions: Vehtari, Gelman, Simpson, Carpenter, Buerkner 2021 (Bayesian Analysis 16:667), as in Stan,
// R posterior and ArviZ. All return NaN where undefined (fewer than four draws, a draw that is not finite);
// a constant quantity has R-hat NaN, an ESS of its number of draws and an MCSE of 0.

double split_rhat(ChainDraws draws);  ///< rank-normalised, folded and split; the larger of bulk and tail
double bulk_ess(ChainDraws draws);
double tail_ess(ChainDraws draws);  ///< the smaller of the 5 % and 95 % quantiles' ESS
double mean_ess(ChainDraws draws);  ///< ESS of the mean, without rank normalisation
double mcse_mean(ChainDraws draws);
double mcse_sd(ChainDraws draws);
double mcse_quantile(ChainDraws draws, double probability);
double quantile(ChainDraws draws, double probability);  ///< type 7, chains pooled
double ebfmi(
    const Eigen::Ref<const Eigen::VectorXd>& energy);  ///< mean squared energy change / energy variance

}  // namespace patina
