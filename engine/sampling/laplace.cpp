#include <Eigen/Eigenvalues>

#include <cmath>
#include <vector>

#include "engine/sampling/finite_evaluation.h"
#include "engine/sampling/map_search.h"
#include "engine/sampling/parallel_for.h"

namespace patina {
namespace {

// In coordinates where the prior is N(0, I), this is below the posterior's sd in all but the stiffest
// directions, and far enough for the rounding of float32 gradients to drown in the difference.
constexpr double kStep = 1e-2;
constexpr double kSmallestCurvature = 0.25;

// Along a jagged coordinate: as wide as the prior allows, down to where the density has fallen by so many
// nats.
constexpr double kWidestStep = 0.5, kSmallestWideStep = 0.01, kWideFall = 8;

/// d grad / d x_i; one-sided where the other side has no density, zero where neither side has.
Eigen::VectorXd hessian_column(const LogDensity& target, const Position& mode, const Evaluation& at_mode,
                               Eigen::Index i) {
  const auto displaced = [&](double by) {
    Position position = mode;
    position.continuous[i] += by;
    return evaluate_finite(target, position);
  };
  const Evaluation above = displaced(kStep), below = displaced(-kStep);
  const bool has_above = std::isfinite(above.log_density), has_below = std::isfinite(below.log_density);
  const Eigen::VectorXd& right = has_above ? above.gradient : at_mode.gradient;
  const Eigen::VectorXd& left = has_below ? below.gradient : at_mode.gradient;
  return (right - left) / (has_above && has_below ? 2 * kStep : kStep);
}

/// The column of a jagged coordinate, over a step wider than the wrinkles: its own curvature from values, the
/// rest from the change of the other gradients.
Eigen::VectorXd jagged_column(const LogDensity& target, const Position& mode, const Evaluation& at_mode,
                              Eigen::Index i) {
  for (double step = kWidestStep;; step /= 2) {
    const auto displaced = [&](double by) {
      Position position = mode;
      position.continuous[i] += by;
      return evaluate_finite(target, position);
    };
    const Evaluation above = displaced(step), below = displaced(-step);
    const double fall = at_mode.log_density - (above.log_density + below.log_density) / 2;
    if (fall > kWideFall && step > kSmallestWideStep) continue;
    if (!std::isfinite(fall)) return Eigen::VectorXd::Zero(mode.continuous.size());
    Eigen::VectorXd column = (above.gradient - below.gradient) / (2 * step);
    column[i] = -2 * fall / (step * step);
    return column;
  }
}

}  // namespace

Eigen::MatrixXd laplace_covariance(const LogDensity& target, const Position& mode, int threads,
                                   const std::function<void()>& enter_thread) {
  const Eigen::Index n = mode.continuous.size();
  const Evaluation at_mode = evaluate_finite(target, mode);
  std::vector<bool> jagged = target.jagged();
  jagged.resize(static_cast<std::size_t>(n));
  Eigen::MatrixXd hessian(n, n);
  const auto work = [&](std::size_t i) {
    const auto k = static_cast<Eigen::Index>(i);
    const auto& column = jagged[i] ? jagged_column : hessian_column;
    hessian.col(k) = column(target, mode, at_mode, k);
  };
  parallel_for(jagged.size(), threads, work, enter_thread);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!jagged[static_cast<std::size_t>(i)]) continue;
    for (Eigen::Index j = 0; j < n; ++j)
      if (jagged[static_cast<std::size_t>(j)] && j != i) hessian(j, i) = 0;
    hessian.row(i) = hessian.col(i).transpose();
  }
  const Eigen::MatrixXd curvature = -(hessian + hessian.transpose()) / 2;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(curvature);
  const Eigen::VectorXd variances = spectrum.eigenvalues().cwiseMax(kSmallestCurvature).cwiseInverse();
  return spectrum.eigenvectors() * variances.asDiagonal() * spectrum.eigenvectors().transpose();
}

}  // namespace patina
