#include "engine/posterior/known_residuals.h"

#include <ATen/core/Tensor.h>
#include <ATen/ops/from_blob.h>

#include <algorithm>
#include <numeric>

#include "engine/sampling/parallel_for.h"

namespace patina {

namespace {

/// [columns, rows], double.
at::Tensor transposed(const Eigen::Ref<const Eigen::MatrixXf>& matrix) {
  // Which at::from_blob() takes for one that may be written to.
  auto* data = const_cast<float*>(matrix.data());
  return at::from_blob(data, {matrix.cols(), matrix.rows()}, {matrix.outerStride(), 1}).to(at::kDouble);
}

/// A^T B in double: in float a product would promise more than a perfect match somewhere.
Eigen::MatrixXd product(const Eigen::MatrixXf& a, const Eigen::MatrixXf& b, int threads,
                        const std::function<void()>& enter_thread) {
  constexpr Eigen::Index kBlock = 128;  // columns in double at a time
  const at::Tensor right = transposed(b).t();
  Eigen::MatrixXd result(a.cols(), b.cols());
  const auto work = [&](std::size_t i) {
    const Eigen::Index first = static_cast<Eigen::Index>(i) * kBlock;
    const Eigen::Index columns = std::min(kBlock, a.cols() - first);
    const at::Tensor block = transposed(a.middleCols(first, columns)).mm(right);
    result.middleRows(first, columns) =
        Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
            block.data_ptr<double>(), columns, b.cols());
  };
  parallel_for(static_cast<std::size_t>((a.cols() + kBlock - 1) / kBlock), threads, work, enter_thread);
  return result;
}

}  // namespace

void KnownResiduals::add(const Eigen::MatrixXd& places, const Eigen::MatrixXf& residuals, int threads,
                         const std::function<void()>& enter_thread) {
  const Eigen::Index before = count(), more = places.cols(), after = before + more;
  all_.places.conservativeResize(places.rows(), after);
  all_.places.rightCols(more) = places;
  residuals_.conservativeResize(residuals.rows(), after);
  residuals_.rightCols(more) = residuals;
  const Eigen::MatrixXd beside = product(residuals_, residuals, threads, enter_thread);
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
