#include "engine/posterior/whitening.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/mv.h>

#include <Eigen/Core>

#include "engine/posterior/wider_errors.h"

namespace patina {

Whitening Whitening::along(const WiderErrors& wider) const {
  Whitening whitening = *this;
  if (wider.variances.size() == 0) return whitening;
  const Eigen::Index entries = wider.directions.rows(), n = wider.directions.cols();
  const at::Tensor rows = at::empty({n, entries}, at::kFloat);  // Eigen's columns
  Eigen::Map<Eigen::MatrixXf>(rows.data_ptr<float>(), entries, n) = wider.directions.cast<float>();
  whitening.directions_ = rows.t();
  whitening.sds_ = at::empty({n}, at::kFloat);
  Eigen::Map<Eigen::VectorXf>(whitening.sds_.data_ptr<float>(), n) =
      (1 + wider.variances.array()).sqrt().matrix().cast<float>();
  return whitening;
}

at::Tensor Whitening::stretched(const at::Tensor& scaled, const at::Tensor& by) const {
  return scaled + at::mv(directions_, (by - 1) * at::mv(directions_.t(), scaled));
}

at::Tensor Whitening::operator()(const at::Tensor& difference) const {
  const at::Tensor scaled = difference * inverse_sigmas_;
  return directions_.defined() ? stretched(scaled, sds_.reciprocal()) : scaled;
}

at::Tensor Whitening::undo(const at::Tensor& white) const {
  return (directions_.defined() ? stretched(white, sds_) : white) / inverse_sigmas_;
}

}  // namespace patina
