#pragma once

#include <Eigen/Core>

namespace patina {

/// How the variance of errors changes with inputs: log variance linear in them, by maximum likelihood of
/// normal errors with a normal prior about no change: weak, and no weaker where there are more inputs.
/// @param errors  one output's, n   @param inputs  inputs x n
/// @return        constant and slopes, 1 + inputs
Eigen::VectorXd fit_log_variance(const Eigen::VectorXd& errors, const Eigen::MatrixXd& inputs);

}  // namespace patina
