#include "engine/summary/image_tensor.h"

#include <ATen/ops/from_blob.h>

#include <cassert>
#include <cstring>

namespace patina {

at::Tensor to_tensor(const Image& image) {
  assert(image.channels == 3 && image.width == image.height);
  auto* pixels = const_cast<float*>(image.pixels.data());
  return at::from_blob(pixels, {image.height, image.width, 3}, at::kFloat).permute({2, 0, 1}).contiguous();
}

Image to_image(const at::Tensor& planes) {
  assert(planes.dim() == 3 && planes.size(0) == 3 && planes.scalar_type() == at::kFloat);
  const at::Tensor pixels = planes.permute({1, 2, 0}).contiguous();
  Image image(static_cast<int>(pixels.size(1)), static_cast<int>(pixels.size(0)), 3);
  std::memcpy(image.pixels.data(), pixels.data_ptr<float>(), image.pixels.size() * sizeof(float));
  return image;
}

}  // namespace patina
