#pragma once

#include <Eigen/Core>

namespace patina {

/// The functions that natural cubic splines are sums of: 1, x and one for every inner knot; twice
/// continuously differentiable, straight beyond the outer knots (Harrell 2015, "Regression Modeling
/// Strategies", section 2.4.5).
class NaturalSplineBasis {
 public:
  /// @param knots  at least three, ascending
  explicit NaturalSplineBasis(Eigen::VectorXd knots);

  const Eigen::VectorXd& knots() const { return knots_; }
  Eigen::Index size() const { return knots_.size(); }
  double clamped(double x) const;          ///< the nearest place between the outer knots
  Eigen::VectorXd values(double x) const;  ///< size(); the first two are 1 and x
  Eigen::VectorXd slopes(double x) const;  ///< their derivatives at x

 private:
  Eigen::VectorXd knots_;
};

}  // namespace patina
