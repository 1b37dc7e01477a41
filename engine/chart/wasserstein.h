#pragma once

#include <Eigen/Core>

#include <vector>

#include "engine/sampling/rng.h"

namespace patina {

/// A sample of one quantity, sorted, that knows how far it may be from the law it was drawn from: its draws
/// are cut into blocks longer than what they remember, which are as good as independent.
class BlockedSample {
 public:
  /// @param draws  draws x chains, at least one   @param ess  effective number of all of them
  BlockedSample(const Eigen::MatrixXd& draws, double ess);

  const std::vector<double>& sorted() const { return values_; }

  /// The root mean square Wasserstein-1 distance between this sample and resamples of its blocks with
  /// replacement (Künsch 1989, "The jackknife and the bootstrap for general stationary observations"): an
  /// estimate of the one between this sample and its law. In the quantity's units.
  double distance_to_law(Rng& rng, int resamples = 50) const;

 private:
  std::vector<double> values_;
  std::vector<int> block_;       ///< of each value
  std::vector<int> block_size_;  ///< of each block
};

/// Wasserstein-1 distance of two samples: the area between their distribution functions. In their units.
/// @param a, b  sorted, not empty
double wasserstein_1(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace patina
