#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "engine/sampling/chain_state.h"
#include "engine/sampling/function_density.h"
#include "engine/sampling/log_density.h"

namespace patina {

/// N(mean, covariance).
class GaussianTarget final : public LogDensity {
 public:
  GaussianTarget(Eigen::VectorXd mean, const Eigen::MatrixXd& covariance)
      : mean_(std::move(mean)), precision_(covariance.inverse()) {}

  Eigen::Index dimension() const override { return mean_.size(); }

  Evaluation evaluate(const Position& position) const override {
    const Eigen::VectorXd offset = position.continuous - mean_;
    const Eigen::VectorXd gradient = -precision_ * offset;
    return {0.5 * offset.dot(gradient), gradient};
  }

 private:
  Eigen::VectorXd mean_;
  Eigen::MatrixXd precision_;
};

/// Of so many coordinates the first.
inline std::vector<bool> first_alone(Eigen::Index dimension) {
  std::vector<bool> chosen(static_cast<std::size_t>(dimension), false);
  chosen.front() = true;
  return chosen;
}

/// N(mean, covariance) with wrinkles along its first coordinate, about a nat high and a thousandth wide, of
/// which the gradient there says nothing: it is N(0, 1)'s.
class JaggedTarget final : public LogDensity {
 public:
  JaggedTarget(const Eigen::VectorXd& mean, const Eigen::MatrixXd& covariance) : smooth_(mean, covariance) {}

  Eigen::Index dimension() const override { return smooth_.dimension(); }
  std::vector<bool> jagged() const override { return first_alone(dimension()); }
  Evaluation evaluate(const Position& position) const override {
    Evaluation evaluation = smooth_.evaluate(position);
    evaluation.log_density += 0.5 * std::sin(1000 * position.continuous[0]);
    evaluation.gradient[0] = 0;
    return evaluation;
  }

 private:
  GaussianTarget smooth_;
};

inline ChainState state_at(const LogDensity& target, Position position) {
  Evaluation evaluation = target.evaluate(position);
  return {std::move(position), std::move(evaluation)};
}

inline KernelSettings settings_with(double step_size, const Eigen::MatrixXd& covariance) {
  return {step_size, std::make_shared<const Metric>(covariance)};
}

/// Symmetric and positive definite, condition number about ten.
inline Eigen::MatrixXd some_covariance(Eigen::Index n) {
  Eigen::MatrixXd root(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) root(i, j) = std::sin(1.0 + 3.0 * i + 7.0 * j) / n;
  return root * root.transpose() + 0.1 * Eigen::MatrixXd::Identity(n, n);
}

}  // namespace patina
