#pragma once

#include <Eigen/Core>

#include <memory>
#include <vector>

#include "engine/sampling/natural_spline.h"

namespace patina {

/// Straightens a bent ridge: y_j = x_j - f_j(x_lead) for the coordinates j that bend along one of them, the
/// lead; the others stay. A triangular map (Parno & Marzouk 2018, "Transport map accelerated Markov chain
/// Monte Carlo") of unit Jacobian, so that a log density is the same number in y as in x. In y, one metric
/// fits the whole ridge, where in x it can fit one place only.
class Shear {
 public:
  /// @param coefficients  basis.size() x dimension: f_j in column j; zero for coordinates that stay, the lead
  /// among them
  Shear(Eigen::Index lead, NaturalSplineBasis basis, Eigen::MatrixXd coefficients);

  Eigen::Index lead() const { return lead_; }

  Eigen::VectorXd straighten(const Eigen::VectorXd& x) const;  ///< y
  Eigen::VectorXd bend(const Eigen::VectorXd& y) const;        ///< x

  /// The gradient with respect to y of a function whose gradient with respect to x is given; and back.
  /// @param lead  the place, x_lead = y_lead
  Eigen::VectorXd gradient_in_y(double lead, Eigen::VectorXd gradient_in_x) const;
  Eigen::VectorXd gradient_in_x(double lead, Eigen::VectorXd gradient_in_y) const;

  /// A covariance of x near a place as one of y, and back: that of the map made linear there.
  Eigen::MatrixXd covariance_in_y(double lead, const Eigen::MatrixXd& covariance_in_x) const;
  Eigen::MatrixXd covariance_in_x(double lead, const Eigen::MatrixXd& covariance_in_y) const;

 private:
  Eigen::VectorXd slopes(double lead) const { return coefficients_.transpose() * basis_.slopes(lead); }

  Eigen::Index lead_;
  NaturalSplineBasis basis_;
  Eigen::MatrixXd coefficients_;
};

/// The shear that straightens a sample best, or null if a straight line does as well. A coordinate counts as
/// bent along another if a spline with knots at five quantiles leaves it at least a quarter less variance
/// than a line does: less is what draws that hang together show by chance.
/// @param chains  positions of each chain, dimension x draws; below 300 draws in all there is no shear
/// @param fixed   coordinates that take no part; empty: none
std::shared_ptr<const Shear> fit_shear(const std::vector<Eigen::MatrixXd>& chains,
                                       const std::vector<bool>& fixed = {});

}  // namespace patina
