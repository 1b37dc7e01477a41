#pragma once

#include <Eigen/Core>

#include <memory>

#include "engine/image.h"
#include "engine/material/capture.h"

namespace patina {

class Resampling;
class Summary;

/// What a predictor sees of a photo: numbers that hardly change with where bumps, cells and flakes lie.
///   of each of the bundled network's Gram matrices the logarithms of the diagonal, and of the first two,
///   small ones the correlations; mean colours of rings and strips; logarithms of spectra; and of the capture
///   the logarithms of the sample's side and of the camera's distance over it.
/// Safe to call from several threads.
class PhotoFeatures {
 public:
  /// @param side  pixels a side at which photos are looked at
  /// @throws UserError if the bundled network cannot be read
  explicit PhotoFeatures(int side);

  Eigen::Index size() const;

  /// @param photo  square, 3 channels, sRGB in [0,1]; resampled to the side
  Eigen::VectorXf operator()(const Image& photo, const Capture& capture) const;

 private:
  int side_;
  std::shared_ptr<const Resampling> resampling_;
  std::shared_ptr<const Summary> summary_;
};

}  // namespace patina
