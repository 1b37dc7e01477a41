#pragma once

#include <Eigen/Core>
#include <Eigen/QR>

namespace patina {

/// Least squares of several outputs on the same inputs.
struct LeastSquares {
  Eigen::MatrixXd coefficients;  ///< outputs x features
  Eigen::MatrixXd residuals;     ///< outputs x n
  Eigen::VectorXd leverages;     ///< n
  double degrees;                ///< of freedom left
  Eigen::MatrixXd root;          ///< R of the design's QR

  /// @param design  n x features, of full rank   @param values  outputs x n
  LeastSquares(const Eigen::MatrixXd& design, const Eigen::MatrixXd& values)
      : degrees(static_cast<double>(design.rows() - design.cols())) {
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(design);
    const Eigen::MatrixXd basis = qr.householderQ() * Eigen::MatrixXd::Identity(design.rows(), design.cols());
    coefficients = qr.solve(values.transpose()).transpose();
    residuals = values - coefficients * design.transpose();
    leverages = basis.rowwise().squaredNorm();
    root = qr.matrixQR().topRows(design.cols()).triangularView<Eigen::Upper>();
  }

  /// Variance of what is predicted for these features, over that of a residual.
  double leverage_of(const Eigen::VectorXd& features) const {
    return root.transpose().triangularView<Eigen::Lower>().solve(features).squaredNorm();
  }

  Eigen::VectorXd variances() const { return residuals.rowwise().squaredNorm() / degrees; }
  Eigen::MatrixXd covariance() const { return residuals * residuals.transpose() / degrees; }

  /// Residuals, each as it would be, had the others alone been regressed.
  Eigen::MatrixXd left_out() const {
    return residuals * (1 - leverages.array()).max(1e-3).inverse().matrix().asDiagonal();
  }
};

}  // namespace patina
