#pragma once

namespace patina {

/// How a photo's summary compares with those of simulated photos.
struct PhotoFit {
  double distance = 1;  ///< root of the photo's chi-square over the simulated photos' mean
  double p = 1;         ///< share of simulated photos that are as far away, the photo counted in
  double widening = 1;  ///< of the errors' covariance: what is beyond 95 % of the simulated photos
  /// Times the hand-set errors that these were off by, beside their irregularities: 0 or 1.
  double discrepancy = 0;
};

/// A smaller p is no accident.
constexpr double kRare = 0.02;

}  // namespace patina
