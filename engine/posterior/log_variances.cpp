#include "engine/posterior/log_variances.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace patina {

Eigen::VectorXd fit_log_variance(const Eigen::VectorXd& errors, const Eigen::MatrixXd& inputs) {
  constexpr double kPriorSd = 0.7, kLongestStep = 1;  // of the slope along all inputs together
  constexpr int kSteps = 12;
  const Eigen::Index n = inputs.cols(), size = inputs.rows() + 1;
  Eigen::MatrixXd design(n, size);
  design << Eigen::VectorXd::Ones(n), inputs.transpose();
  const Eigen::VectorXd squares = errors.cwiseAbs2();
  Eigen::VectorXd precisions =
      Eigen::VectorXd::Constant(size, static_cast<double>(inputs.rows()) / (kPriorSd * kPriorSd));
  precisions[0] = 0;
  // Fisher scoring (McCullagh & Nelder 1989, gamma errors with a logarithmic link).
  const Eigen::MatrixXd information =
      0.5 * design.transpose() * design + Eigen::MatrixXd(precisions.asDiagonal());
  const Eigen::LLT<Eigen::MatrixXd> solver(information);
  Eigen::VectorXd fitted = Eigen::VectorXd::Zero(size);
  fitted[0] = std::log(std::max(squares.mean(), 1e-300));
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::ArrayXd log_variances = design * fitted;
    const Eigen::VectorXd excess = 0.5 * (squares.array() * (-log_variances).exp() - 1).matrix();
    const Eigen::VectorXd change =
        solver.solve(design.transpose() * excess - precisions.cwiseProduct(fitted));
    fitted += change * std::min(1.0, kLongestStep / std::max(change.norm(), 1e-12));
  }
  return fitted;
}

}  // namespace patina
