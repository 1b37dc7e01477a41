#pragma once

#include <cmath>

#include "engine/sampling/rng.h"

namespace patina {

/// Chains that are N(0, 1) from the first draw on and remember: x' = rho x + sqrt(1 - rho^2) N(0, 1).
inline Eigen::MatrixXd autoregressive_draws(Eigen::Index draws, Eigen::Index chains, double rho, Rng& rng) {
  Eigen::MatrixXd matrix(draws, chains);
  for (Eigen::Index k = 0; k < chains; ++k)
    for (Eigen::Index i = 0; i < draws; ++i)
      matrix(i, k) = i == 0 ? rng.normal() : rho * matrix(i - 1, k) + std::sqrt(1 - rho * rho) * rng.normal();
  return matrix;
}

}  // namespace patina
