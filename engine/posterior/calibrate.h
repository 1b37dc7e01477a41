#pragma once

#include <Eigen/Core>

#include <functional>

#include "engine/posterior/photo_fit.h"
#include "engine/posterior/pilot.h"
#include "engine/posterior/posterior.h"
#include "engine/posterior/regressed_likelihood.h"
#include "engine/posterior/simulate.h"

namespace patina {

/// How much is simulated to learn a likelihood.
struct CalibrationSettings {
  int pilot = 1000;  ///< photos of the prior, of use to all photos of a material
  int round = 150;   ///< photos of each round at least; see photos_a_round()
  int most_rounds = 6;
};

/// A likelihood of simulations around a photo's posterior, and that posterior's normal approximation.
struct Calibration {
  RegressedLikelihood likelihood;
  PhotoFit fit;
  Eigen::VectorXd mode;        ///< of all coordinates
  Eigen::MatrixXd covariance;  ///< of Laplace's approximation there
  int photos = 0;              ///< that were simulated, the pilot's left out
};

/// What takes a while, and is asked for at most where a photo needs it.
struct OnDemand {
  std::function<const Pilot&()> pilot;     ///< where there are no guesses
  std::function<Eigen::VectorXd()> match;  ///< the mode of the hand-set errors, all coordinates
};

/// Photos that the material can make are explained by irregularities alone. A photo that is further from
/// simulated ones than kRare of them are from each other, as real ones often are, is compared with photos
/// that are off by the hand-set errors as well, about its best match by these: what a material cannot make
/// misleads guesses. What is then still rare widens the errors. In rounds: photos are simulated about as far
/// as the posterior reaches, by the round before; the likelihood that they make moves and narrows the
/// posterior; and they say by what scores the next round's are compared, beside the first round's, which are
/// guesses, without these a pilot's, or taught by photos about the match. It ends with the second round whose
/// posterior is where, and as wide as, its photos are. Rounds and their normal approximations take errors for
/// normal, the likelihood that is left has their heavier tails.
/// @param simulator  of the photo's posterior
Calibration calibrate(const Simulator& simulator, const Image& photo, const OnDemand& on_demand,
                      const CalibrationSettings& settings);

}  // namespace patina
