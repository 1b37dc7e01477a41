#pragma once

#include <Eigen/Core>

#include <limits>

namespace patina {

/// The Gram matrix X^T X of inputs, as far as it is not zero: vectors values vectors^T, from whichever of
/// X^T X and X X^T is the smaller.
struct Spectrum {
  Eigen::MatrixXd vectors;  ///< n x rank
  Eigen::VectorXd values;

  /// @param inputs  X, inputs x n
  explicit Spectrum(const Eigen::MatrixXd& inputs);
};

/// Ridge regression of one target on inputs, of the strength that predicts best what is left out.
struct RidgeFit {
  Eigen::VectorXd dual;    ///< the coefficients are X dual
  Eigen::VectorXd errors;  ///< of each, as predicted by the others
  double damping = 0;      ///< added to the Gram matrix
  double usual_leverage = 0;
  double loss = std::numeric_limits<double>::infinity();  ///< squared errors, of noise as well
};

/// @param target  n   @param mean_leverages  n, of the mean that target and inputs have lost before
/// @param noise   variance of independent noise that is to be in every input, and is not in these. On average
///                over it a Gram matrix has n times as much on its diagonal (noise as regularisation: Bishop
///                1995), and the errors' squares the noise's share
RidgeFit fit_ridge(const Eigen::VectorXd& target, const Spectrum& spectrum,
                   const Eigen::VectorXd& mean_leverages, double noise = 0);

}  // namespace patina
