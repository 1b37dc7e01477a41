#pragma once

#include <Eigen/Core>

#include <vector>

#include "engine/material/parameter.h"
#include "engine/sampling/rng.h"

namespace patina {

/// What a predictor makes of a photo: a normal distribution of a material's parameters, in coordinates in
/// which each one's prior is N(0, 1) (PriorTransform), and a probability of every level of its choices.
struct Prediction {
  ParameterTable table;                              ///< with the priors that the coordinates are of
  Eigen::VectorXd mean;                              ///< of the coordinates of table.continuous
  Eigen::MatrixXd precision_factor;                  ///< L, lower triangular: their precision is L L^T
  std::vector<Eigen::VectorXd> level_probabilities;  ///< one of each of table.discrete

  ParameterValues likeliest() const;     ///< at the mean, and of each choice the likeliest level
  ParameterValues draw(Rng& rng) const;  ///< parameters of a draw
  Eigen::VectorXd deviations() const;    ///< sd of each coordinate; about 1: the photo says nothing of it
  /// Logarithm of the distribution's density at coordinates and levels.
  double log_density(const Eigen::VectorXd& coordinates, const std::vector<int>& levels) const;
};

}  // namespace patina
