#pragma once

#include <Eigen/Core>

namespace patina {

/// a b, of large matrices, by libtorch's BLAS: Eigen's own products are built for the oldest processor that
/// Patina runs on.
Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace patina
