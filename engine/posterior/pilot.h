#pragma once

#include <Eigen/Core>

#include "engine/posterior/region.h"
#include "engine/posterior/scores.h"
#include "engine/posterior/simulate.h"

namespace patina {

/// What photos of the whole prior say of any photo of a material: first scores, and about where a photo's
/// posterior lies.
class Pilot {
 public:
  Pilot(const Simulator& simulator, int photos);

  const Scores& scores() const { return scores_; }

  /// About the posterior of a photo with these scores: local linear regression of the places of the simulated
  /// photos that are most like it (Beaumont et al. 2002).
  Region region(const Eigen::VectorXd& scores) const;

 private:
  SimulatedPhotos photos_;
  Scores scores_;
  Eigen::MatrixXd precision_;  ///< of the scores' errors
};

}  // namespace patina
