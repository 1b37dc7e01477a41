#pragma once

namespace patina {

/// How a photo's summary compares with those of simulated photos.
struct PhotoFit {
  double distance = 1;  ///< root of the photo's chi-square over the simulated photos' mean
  double p = 1;         ///< share of simulated photos that are as far away, the photo counted in
  double widening = 1;  ///< of the errors' covariance: what is beyond 95 % of the simulated photos
};

}  // namespace patina
