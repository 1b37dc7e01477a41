#pragma once

#include <Eigen/Core>

#include <memory>
#include <vector>

#include "engine/sampling/log_density.h"
#include "engine/sampling/natural_spline.h"

namespace patina {

/// Straightens a bent ridge and makes it equally wide all along: y_j = (x_j - f_j(x_lead)) / s_j(x_lead) for
/// the coordinates j that bend along one of them, the lead; the others stay. A triangular transport map
/// (Parno & Marzouk 2018, "Transport map accelerated Markov chain Monte Carlo"). In y, one metric fits the
/// whole ridge, where in x it can fit one place only.
class Straightening {
 public:
  /// What is a function of the lead: basis.size() x dimension, a coordinate's function in its column.
  struct Coefficients {
    Eigen::MatrixXd middle;     ///< f_j
    Eigen::MatrixXd log_width;  ///< log s_j; beyond the outer knots it keeps its value there
  };

  /// @param coefficients  zero for coordinates that stay, the lead among them
  Straightening(Eigen::Index lead, NaturalSplineBasis basis, Coefficients coefficients);

  Eigen::Index dimension() const { return coefficients_.middle.cols(); }
  Eigen::Index lead() const { return lead_; }
  const NaturalSplineBasis& basis() const { return basis_; }
  const Coefficients& coefficients() const { return coefficients_; }

  Eigen::VectorXd straighten(const Eigen::VectorXd& x) const;  ///< y
  Eigen::VectorXd bend(const Eigen::VectorXd& y) const;        ///< x

  /// The log density of y, |dx/dy| included, and its gradient there, from that of x; and back.
  /// An empty gradient stays empty.
  Evaluation density_of_y(const Eigen::VectorXd& y, const Evaluation& of_x) const;
  Evaluation density_of_x(const Eigen::VectorXd& y, const Evaluation& of_y) const;

  /// A covariance of x near the middle of the ridge as one of y, and back: that of the map made linear there.
  /// @param lead  the place, x_lead = y_lead
  Eigen::MatrixXd covariance_in_y(double lead, const Eigen::MatrixXd& covariance_in_x) const;
  Eigen::MatrixXd covariance_in_x(double lead, const Eigen::MatrixXd& covariance_in_y) const;

 private:
  Eigen::VectorXd middle(double lead) const { return coefficients_.middle.transpose() * basis_.values(lead); }
  Eigen::VectorXd log_width(double lead) const;
  Eigen::VectorXd middle_slope(double lead) const;
  Eigen::VectorXd log_width_slope(double lead) const;

  Eigen::Index lead_;
  NaturalSplineBasis basis_;
  Coefficients coefficients_;
};

/// The map that straightens a sample best, or null if a straight line of one width does about as well: a
/// coordinate counts as bent along another if knowing its middle and width there, by splines with knots at
/// nine quantiles (five below 1000 draws), makes it better predicted than a line does by 0.3 (0.2) nats a
/// draw. Less is what draws that hang together show by chance.
/// @param chains  positions of each chain, dimension x draws; below 300 draws in all there is no map
/// @param fixed   coordinates that take no part; empty: none
std::shared_ptr<const Straightening> fit_straightening(const std::vector<Eigen::MatrixXd>& chains,
                                                       const std::vector<bool>& fixed = {});

}  // namespace patina
