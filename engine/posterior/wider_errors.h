#pragma once

#include <Eigen/Core>

#include "engine/posterior/simulate.h"

namespace patina {

class Archive;

/// Directions of a summary along which its errors are wider than those set by hand.
struct WiderErrors {
  Eigen::MatrixXd directions;  ///< entries x n, orthonormal, in units of the hand-set errors
  Eigen::VectorXd variances;   ///< n, what each adds to the hand-set errors' 1

  /// Half of them: where renders are averaged over irregularities, the photo's alone are left.
  WiderErrors of_the_photo() const { return {directions, variances / 2}; }

  /// Whether they can be of a summary of so many entries: sizes, numbers that are finite, directions.
  bool are_of(Eigen::Index entries) const;
  void serialise(Archive& archive);
};

constexpr double kWidest = 12;  ///< of a photo's irregularities, beside a hand-set error's variance of 1

constexpr int kIrregularityPhotos = 48;  ///< of a dozen directions that matter

/// What irregularities do to the summaries of a material at one place: of the photo, whose own nobody knows,
/// and of renders, which have those of the run's one z. So their covariance counts twice (Wood 2010,
/// "Statistical inference for noisy nonlinear ecological dynamic systems", where simulations are many and it
/// counts once). Along its principal axes, as far as they matter, and no further than kWidest: what
/// irregularities do at one match is not what they do at others. At wood_3's, where dark rings may lie under
/// the highlight, they scatter a photo by 115 to 140 hand-set variances along one axis; matches without any
/// highlight were as good then, and which of them was a matter of the seed.
/// @param at      its informed coordinates; places and levels are drawn from their prior
/// @param photos  that are simulated
WiderErrors errors_of_irregularities(const Simulator& simulator, const Position& at,
                                     int photos = kIrregularityPhotos);

}  // namespace patina
