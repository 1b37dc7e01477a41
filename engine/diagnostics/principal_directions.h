#pragma once

#include <Eigen/Core>

#include <vector>

namespace patina {

/// A direction in the space of quantities that were each brought to mean 0 and sd 1.
struct PrincipalDirection {
  Eigen::VectorXd loadings;  ///< of length 1, the largest one positive; 0 for a quantity that never changes
  double share = 0;          ///< of the draws' variance, in (0, 1]
};

/// The directions in which draws spread most, widest first: eigenvectors of their correlation matrix
/// (Jolliffe 2002, "Principal Component Analysis", section 2.3). Chains that agree on every quantity may
/// still disagree along one of these.
/// @param draws  draws x quantities   @param most  at most that many; fewer where fewer quantities change
std::vector<PrincipalDirection> principal_directions(const Eigen::MatrixXd& draws, int most);

/// Draws along a direction: one value per draw, in units of the quantities' standard deviations.
Eigen::VectorXd along(const PrincipalDirection& direction, const Eigen::MatrixXd& draws);

}  // namespace patina
