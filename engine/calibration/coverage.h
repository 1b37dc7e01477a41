#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

#include "engine/sampling/rng.h"

namespace patina {

// Simulation-based calibration (Talts et al. 2018): where the truth is a draw of the prior, its place among
// the draws of the posterior given data made of it is uniform on (0, 1).

constexpr std::array kIntervals{0.5, 0.8, 0.9, 0.95};

/// The truth's place among draws: (draws below + a uniform share of those equal and of one) / (draws + 1).
double place_among(const Eigen::Ref<const Eigen::MatrixXd>& draws, double truth, Rng& rng);

/// How often central intervals hold the truth, of one quantity over many data sets.
struct Coverage {
  int count = 0;
  std::array<double, kIntervals.size()> share{};  ///< per interval
  double chi_square = 0;  ///< Pearson's, of places in ten bins against the uniform law: 9 degrees of freedom
  double uniformity = 1;  ///< its p-value

  /// Binomial standard error of a share, were the interval's promise true.
  double error(std::size_t interval) const;
};

/// @param places  of place_among()
Coverage coverage(const std::vector<double>& places);

}  // namespace patina
