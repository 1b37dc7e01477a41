#include "engine/diagnostics/principal_directions.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace patina {
namespace {

/// Each column less its mean, over its standard deviation; zero where it does not change.
Eigen::MatrixXd standardised(const Eigen::MatrixXd& draws) {
  Eigen::MatrixXd result = draws.rowwise() - draws.colwise().mean();
  for (auto column : result.colwise()) {
    const double sd =
        std::sqrt(column.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(column.size() - 1, 1)));
    if (sd > 0 && std::isfinite(sd))
      column /= sd;
    else
      column.setZero();
  }
  return result;
}

}  // namespace

std::vector<PrincipalDirection> principal_directions(const Eigen::MatrixXd& draws, int most) {
  if (draws.rows() < 2 || draws.cols() == 0) return {};
  const Eigen::MatrixXd z = standardised(draws);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(z.transpose() * z /
                                                              static_cast<double>(z.rows() - 1));
  const Eigen::VectorXd& variances = solver.eigenvalues();  // ascending
  std::vector<PrincipalDirection> directions;
  for (Eigen::Index i = variances.size() - 1; i >= 0 && std::ssize(directions) < most; --i) {
    if (!(variances[i] > 1e-9)) break;
    Eigen::VectorXd loadings = solver.eigenvectors().col(i);
    Eigen::Index largest = 0;
    loadings.cwiseAbs().maxCoeff(&largest);
    if (loadings[largest] < 0) loadings = -loadings;
    directions.push_back({loadings, variances[i] / variances.sum()});
  }
  return directions;
}

Eigen::VectorXd along(const PrincipalDirection& direction, const Eigen::MatrixXd& draws) {
  return standardised(draws) * direction.loadings;
}

}  // namespace patina
