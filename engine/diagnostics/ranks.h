#pragma once

#include <Eigen/Core>

#include <vector>

namespace patina {

/// Each chain cut in two: the first and the last floor(n/2) draws (the middle one of an odd number is
/// dropped).
/// @param draws  n x M   @return floor(n/2) x 2M, the first halves, then the last ones
Eigen::MatrixXd split_chains(const Eigen::Ref<const Eigen::MatrixXd>& draws);

/// Normal scores z = Phi^-1((r - 3/8) / (S + 1/4)) of the ranks r among all S values (Blom 1958), ties at
/// their average rank. Same shape as draws.
Eigen::MatrixXd rank_normalise(const Eigen::MatrixXd& draws);

std::vector<double> sorted_values(const Eigen::Ref<const Eigen::MatrixXd>& draws);

/// Type 7 of Hyndman & Fan 1996 (R's and NumPy's default): linear between order statistics.
/// @param sorted  ascending, not empty   @param probability  in [0, 1]
double sorted_quantile(const std::vector<double>& sorted, double probability);

}  // namespace patina
