#include "engine/diagnostics/conditioning.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace patina {

Conditioning condition(const Eigen::MatrixXd& draws, const std::vector<Eigen::Index>& held,
                       const Eigen::VectorXd& values) {
  const Eigen::Index n = draws.cols();
  Conditioning result{Eigen::VectorXd::Zero(n), Eigen::VectorXd::Ones(n)};
  if (draws.rows() < 2 || held.empty()) return result;
  const Eigen::RowVectorXd means = draws.colwise().mean();
  const Eigen::MatrixXd centred = draws.rowwise() - means;
  const Eigen::MatrixXd covariance = centred.transpose() * centred / static_cast<double>(draws.rows() - 1);
  const Eigen::MatrixXd among = covariance(held, held), towards = covariance(held, Eigen::all);
  // A held quantity that never changes leaves a row of zeros: the least squares of least norm ignores it.
  const Eigen::MatrixXd slopes = among.completeOrthogonalDecomposition().solve(towards);
  const Eigen::VectorXd moved = slopes.transpose() * (values - means(held).transpose());
  for (Eigen::Index i = 0; i < n; ++i) {
    const double variance = covariance(i, i);
    if (!(variance > 0) || std::ranges::count(held, i) > 0) continue;
    result.shift[i] = moved[i] / std::sqrt(variance);
    const double explained = slopes.col(i).dot(towards.col(i)) / variance;
    result.narrowing[i] = std::sqrt(std::clamp(1 - explained, 0.0, 1.0));
  }
  return result;
}

}  // namespace patina
