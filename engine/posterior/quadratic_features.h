#pragma once

#include <Eigen/Core>

namespace patina {

/// What a regression is on: 1, v_i, v_i^2 and, on demand, v_i v_j.
class QuadraticFeatures {
 public:
  /// @param dimension  of v   @param products  whether v_i v_j are among them
  QuadraticFeatures(Eigen::Index dimension, bool products) : dimension_(dimension), products_(products) {}

  Eigen::Index size() const;
  Eigen::VectorXd values(const Eigen::VectorXd& v) const;
  Eigen::MatrixXd design(const Eigen::MatrixXd& offsets) const;  ///< of the columns, n x size()

 private:
  Eigen::Index dimension_;
  bool products_;
};

}  // namespace patina
