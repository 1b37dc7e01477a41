#pragma once

#include <Eigen/Core>

#include "engine/posterior/posterior.h"
#include "engine/posterior/simulation_settings.h"

namespace patina {

/// A posterior whose errors are calibrated, and its mode.
struct CalibratedPosterior {
  Posterior posterior;
  Position mode;
  Evaluation at_mode;
  Eigen::MatrixXd covariance;  ///< of Laplace's approximation there
};

/// In rounds: photos are simulated about as far around the mode as the posterior reaches, the likelihood that
/// they make (synthetic_likelihood.h) moves the mode and narrows the posterior, and so on from there. A
/// round's photos reach half as far again as the posterior of the round before.
/// @param mode        of another error model's posterior, discrete levels to stay at
/// @param covariance  of Laplace's approximation there
CalibratedPosterior calibrate(const Posterior& posterior, const Position& mode,
                              const Eigen::MatrixXd& covariance, const SimulationSettings& settings,
                              IrregularityPool& pool);

}  // namespace patina
