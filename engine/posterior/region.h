#pragma once

#include <Eigen/Core>

namespace patina {

/// Where photos are simulated: x = centre + factor v, v ~ N(0, I), x the informed coordinates.
struct Region {
  Eigen::VectorXd centre;
  Eigen::MatrixXd factor;  ///< lower triangular

  Eigen::VectorXd place(const Eigen::VectorXd& offset) const { return centre + factor * offset; }
  Eigen::VectorXd offset(const Eigen::VectorXd& place) const {
    return factor.triangularView<Eigen::Lower>().solve(place - centre);
  }
};

/// All of the prior N(0, I).
Region prior_region(Eigen::Index dimension);

/// Somewhat wider than N(centre, covariance), but nowhere wider than the prior, and not much narrower than
/// the region that they were found by: what is bent there can have moved the centre by a part of its width.
Region region_around(const Eigen::VectorXd& centre, const Eigen::MatrixXd& covariance,
                     const Region& found_by);

}  // namespace patina
