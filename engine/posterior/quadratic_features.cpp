#include "engine/posterior/quadratic_features.h"

namespace patina {

Eigen::Index QuadraticFeatures::size() const {
  const Eigen::Index squares = 1 + 2 * dimension_;
  return products_ ? squares + dimension_ * (dimension_ - 1) / 2 : squares;
}

Eigen::VectorXd QuadraticFeatures::values(const Eigen::VectorXd& v) const {
  Eigen::VectorXd values(size());
  values.head(1 + 2 * dimension_) << 1, v, v.cwiseAbs2();
  Eigen::Index k = 1 + 2 * dimension_;
  for (Eigen::Index i = 0; products_ && i < dimension_; ++i)
    for (Eigen::Index j = 0; j < i; ++j) values[k++] = v[i] * v[j];
  return values;
}

Eigen::MatrixXd QuadraticFeatures::design(const Eigen::MatrixXd& offsets) const {
  Eigen::MatrixXd design(offsets.cols(), size());
  for (Eigen::Index i = 0; i < offsets.cols(); ++i) design.row(i) = values(offsets.col(i));
  return design;
}

}  // namespace patina
