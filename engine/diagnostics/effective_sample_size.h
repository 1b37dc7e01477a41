#pragma once

#include <Eigen/Core>

namespace patina {

/// Autocovariance at lags 0 ... n-1 of each chain about its own mean, biased (divided by n), averaged over
/// chains. By Fourier transform (Wiener-Khinchin), so that slowly mixing chains cost no more than others.
/// @param chains  n x M
Eigen::VectorXd mean_autocovariance(const Eigen::MatrixXd& chains);

/// Effective number of draws of the mean of all columns: Geyer's initial monotone sequence (Geyer 1992) over
/// the chains' joint autocorrelation, at most S log10 S (Vehtari et al. 2021, section 3.2). The columns are
/// taken as they are; see split_chains().
/// @param chains  n x M, n >= 2, not constant
double effective_sample_size(const Eigen::MatrixXd& chains);

}  // namespace patina
