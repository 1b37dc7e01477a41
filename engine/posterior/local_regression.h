#pragma once

#include <Eigen/Core>

namespace patina {

/// Where photos were simulated, regressed on their scores about a photo that was observed: ridge regressions,
/// each as strong as predicts best what is left out, with more weight on photos that seem to be near (local
/// regression, Beaumont et al. 2002). How far a target's errors spread is taken of photos of which much the
/// same of that target is predicted: a rough surface tells its bumps less well than a smooth one.
struct LocalRegression {
  Eigen::VectorXd mean;       ///< for what was observed, targets
  Eigen::VectorXd sd;         ///< of its errors, what is unknown of the mean included, targets
  Eigen::MatrixXd predicted;  ///< of the simulated photos, targets x n
  Eigen::MatrixXd errors;     ///< of each, had the others alone been regressed, times sqrt(weight)
};

/// @param offsets   targets x n   @param scores  scores x n   @param observed  scores of the photo
LocalRegression local_regression(const Eigen::MatrixXd& offsets, const Eigen::MatrixXd& scores,
                                 const Eigen::VectorXd& observed);

}  // namespace patina
