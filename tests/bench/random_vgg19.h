#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace patina {

/// A convolution of 3 x 3 on a square map.
struct ConvolutionShape {
  std::int64_t in, out, side;

  /// Multiplications and additions.
  double operations() const { return 2.0 * 3 * 3 * static_cast<double>(in * out * side * side); }
};

/// Those of VGG-19 (Simonyan and Zisserman 2015, configuration E) on an image.
std::vector<ConvolutionShape> vgg19_shapes(std::int64_t side);

/// A file of VGG-19 with weights of which activations neither vanish nor explode (He et al. 2015), by
/// torchvision's names: what times are taken with where its learnt weights are not at hand.
void write_random_vgg19(const std::filesystem::path& file);

}  // namespace patina
