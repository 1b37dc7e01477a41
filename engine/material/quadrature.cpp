#include "engine/material/quadrature.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace patina {

Quadrature gauss_legendre(int count) {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(count);
  Eigen::VectorXd beside(count - 1);  // of the recurrence of Legendre's polynomials
  for (int k = 1; k < count; ++k) beside[k - 1] = k / std::sqrt(4.0 * k * k - 1);
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> jacobi;
  jacobi.computeFromTridiagonal(none, beside);

  Quadrature result;
  for (int i = 0; i < count; ++i) {
    const double first = jacobi.eigenvectors()(0, i);
    result.nodes.push_back((1 + jacobi.eigenvalues()[i]) / 2);
    result.weights.push_back(first * first);
  }
  return result;
}

}  // namespace patina
