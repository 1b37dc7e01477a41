#include "engine/posterior/matrix_product.h"

#include <ATen/core/Tensor.h>
#include <ATen/ops/from_blob.h>

#include <cassert>

namespace patina {
namespace {

/// The same memory: Eigen's columns are a tensor's rows.
at::Tensor transposed(const Eigen::MatrixXd& matrix) {
  auto* data = const_cast<double*>(matrix.data());  // which at::from_blob() takes for one that is written to
  return at::from_blob(data, {matrix.cols(), matrix.rows()}, at::kDouble);
}

}  // namespace

Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  assert(a.cols() == b.rows());
  const at::Tensor result = transposed(b).mm(transposed(a));
  return Eigen::Map<const Eigen::MatrixXd>(result.data_ptr<double>(), a.rows(), b.cols());
}

}  // namespace patina
