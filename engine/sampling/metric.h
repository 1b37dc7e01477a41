#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace patina {

/// A dense metric: an estimate of the posterior covariance C = L L^T that preconditions the kernels.
class Metric {
 public:
  /// @throws std::invalid_argument unless covariance is square, symmetric and positive definite
  explicit Metric(const Eigen::MatrixXd& covariance);
  static Metric identity(Eigen::Index dimension);

  Eigen::Index dimension() const { return covariance_.rows(); }
  const Eigen::MatrixXd& covariance() const { return covariance_; }

  Eigen::VectorXd multiply(const Eigen::VectorXd& v) const { return covariance_ * v; }  ///< C v
  Eigen::VectorXd colour(const Eigen::VectorXd& v) const;             ///< L v: white noise to N(0, C)
  Eigen::VectorXd colour_transposed(const Eigen::VectorXd& v) const;  ///< L^T v
  double inverse_norm2(const Eigen::VectorXd& v) const;               ///< v^T C^-1 v

 private:
  Eigen::MatrixXd covariance_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

}  // namespace patina
