#include "engine/posterior/known_residuals.h"

#include <algorithm>
#include <numeric>

namespace patina {

namespace {

/// A^T B in double: in float a product would promise more than a perfect match somewhere.
Eigen::MatrixXd product(const Eigen::MatrixXf& a, const Eigen::MatrixXf& b) {
  constexpr Eigen::Index kBlock = 256;  // columns in double at a time
  const Eigen::MatrixXd right = b.cast<double>();
  Eigen::MatrixXd result(a.cols(), b.cols());
  for (Eigen::Index first = 0; first < a.cols(); first += kBlock) {
    const Eigen::Index columns = std::min(kBlock, a.cols() - first);
    const Eigen::MatrixXd left = a.middleCols(first, columns).cast<double>();
    result.middleRows(first, columns).noalias() = left.transpose() * right;
  }
  return result;
}

}  // namespace

void KnownResiduals::add(const Eigen::MatrixXd& places, const Eigen::MatrixXf& residuals) {
  const Eigen::Index before = count(), more = places.cols(), after = before + more;
  all_.places.conservativeResize(places.rows(), after);
  all_.places.rightCols(more) = places;
  residuals_.conservativeResize(residuals.rows(), after);
  residuals_.rightCols(more) = residuals;
  const Eigen::MatrixXd beside = product(residuals_, residuals);
  all_.products.conservativeResize(after, after);
  all_.products.rightCols(more) = beside;
  all_.products.bottomLeftCorner(more, before) = beside.topRows(before).transpose();
}

EmulatorExamples KnownResiduals::some(const std::vector<Eigen::Index>& which) const {
  return {all_.places(Eigen::all, which), all_.products(which, which)};
}

EmulatorExamples KnownResiduals::worth_learning(Eigen::Index least) const {
  constexpr double kFar = 5;  // nats a coordinate
  const Eigen::VectorXd energies = all_.energies();
  std::vector<Eigen::Index> order(static_cast<std::size_t>(count()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](Eigen::Index i) { return energies[i]; });
  const double far = energies[order.front()] + kFar * static_cast<double>(all_.places.rows());
  while (std::ssize(order) > least && energies[order.back()] > far) order.pop_back();
  return some(order);
}

}  // namespace patina
