#pragma once

#include <Eigen/Core>

#include <cmath>
#include <random>

namespace patina {

/// n x M independent AR(1) series with unit variance and the given correlation of neighbours.
inline Eigen::MatrixXd ar1(Eigen::Index n, Eigen::Index chains, double correlation, unsigned seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd draws(n, chains);
  for (auto chain : draws.colwise()) {
    chain[0] = normal(generator);
    for (Eigen::Index t = 1; t < n; ++t)
      chain[t] = correlation * chain[t - 1] + std::sqrt(1 - correlation * correlation) * normal(generator);
  }
  return draws;
}

}  // namespace patina
