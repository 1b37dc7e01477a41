#pragma once

#include <ATen/core/Tensor.h>

#include "engine/posterior/forward_model.h"
#include "engine/posterior/irregularity_pool.h"
#include "engine/posterior/parameter_space.h"
#include "engine/posterior/simulation_settings.h"
#include "engine/posterior/synthetic_likelihood.h"

namespace patina {

/// Photos of N(centre, covariance); places are drawn from their prior, levels are the centre's.
/// @param inverse_sigma  [p]: summaries are in units of the hand-set errors
SimulatedPhotos simulate(const ForwardModel& model, const ParameterSpace& space,
                         const at::Tensor& inverse_sigma, const Position& centre,
                         const Eigen::MatrixXd& covariance, const SimulationSettings& settings,
                         IrregularityPool& pool);

}  // namespace patina
