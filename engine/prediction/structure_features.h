#pragma once

#include <Eigen/Core>

#include <memory>

#include "engine/image.h"

namespace patina {

class Summary;

/// What a surface's structure looks like, whatever its colour, the light and the camera's exposure: the
/// logarithm of the luminance less its mean nearby, over its spread nearby (local contrast normalisation;
/// Jarrett et al. 2009, "What is the best multi-stage architecture for object recognition?"), as a grey image
/// through the bundled network; of each feature map's covariances the logarithms of the diagonal, and of the
/// first two, small ones the correlations. At two scales. Photographs differ from renders in colour and light
/// more than in structure.
/// Safe to call from several threads.
class StructureFeatures {
 public:
  static constexpr int kSide = 256;  ///< pixels a side at which photos are looked at, then at half of it

  /// @throws UserError if the bundled network cannot be read
  StructureFeatures();

  Eigen::Index size() const;

  /// @param photo  square, 3 channels, sRGB in [0,1]; resampled to kSide
  Eigen::VectorXf operator()(const Image& photo) const;

 private:
  std::shared_ptr<const Summary> covariances_;
};

}  // namespace patina
