#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "engine/image.h"

namespace patina {

class Network;

/// How unlike a picture's texture is to a photo's, wherever in either its features lie.
///
/// Covariances of a network's features, level by level: Gram matrices (gram.h) less what their mean alone
/// makes, since mean colours tell materials apart far less than they weigh in a Gram matrix. Safe to call
/// from several threads.
class TextureDistance {
 public:
  /// @param photo       square, 3 channels, sRGB in [0,1]; resampled to the resolution
  /// @param resolution  pixels a side of the pictures that it is compared with
  /// @param network     a weights file; empty for the bundled one   @throws UserError
  TextureDistance(const Image& photo, int resolution, const std::filesystem::path& network);
  ~TextureDistance();

  int resolution() const { return resolution_; }

  /// The mean over levels of |C - C'| over the mean of |C| and |C'|, Frobenius norms: 0 of the same picture,
  /// 2 at most, where one of them has no texture at all.
  /// @param render  resolution() pixels a side, 3 channels, sRGB in [0,1]
  double operator()(const Image& render) const;

 private:
  using Level = std::vector<float>;
  std::vector<Level> covariances(const Image& image) const;

  int resolution_;
  std::unique_ptr<const Network> network_;
  std::vector<Level> photo_;
};

}  // namespace patina
