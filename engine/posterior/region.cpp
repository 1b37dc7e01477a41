#include "engine/posterior/region.h"

#include <Eigen/Cholesky>

namespace patina {

Region prior_region(Eigen::Index dimension) {
  return {Eigen::VectorXd::Zero(dimension), Eigen::MatrixXd::Identity(dimension, dimension)};
}

Region region_around(const Eigen::VectorXd& centre, const Eigen::MatrixXd& covariance,
                     const Region& found_by) {
  // kReach times as far where the covariance is far below the prior's, and the prior's own where it is that.
  // With the mean that goes with that width (prior times likelihood^kShare; nearer to the prior's) in place
  // of the centre, 90 % intervals of wood's albedos held 83 to 86 % of 107 truths, and not 88 to 91.
  constexpr double kReach = 1.5, kShare = 1 / (kReach * kReach);
  // Of the old width. Of 24 photos of leather intervals held the truth as often with 0.3 as with 0.7, and
  // were up to a third narrower.
  constexpr double kDoubt = 0.3;
  const Eigen::MatrixXd doubted =
      covariance + kDoubt * kDoubt * found_by.factor * found_by.factor.transpose();
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(centre.size(), centre.size());
  const Eigen::MatrixXd precision = kShare * doubted.llt().solve(one) + (1 - kShare) * one;
  return {centre, precision.llt().solve(one).llt().matrixL()};
}

}  // namespace patina
