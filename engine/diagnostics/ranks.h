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

/// All draws in one row, chain after chain.
std::vector<double> pooled_values(const Eigen::Ref<const Eigen::MatrixXd>& draws);

/// The value that would be at `index` were the values sorted; reorders them (linear time).
double order_statistic(std::vector<double>& values, std::size_t index);

/// Type 7 of Hyndman & Fan 1996 (R's and NumPy's default): linear between order statistics. Reorders the
/// values.
/// @param values  not empty   @param probability  in [0, 1]
double quantile_of(std::vector<double>& values, double probability);

}  // namespace patina
