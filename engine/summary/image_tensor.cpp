#include "engine/summary/image_tensor.h"

#include <ATen/ops/from_blob.h>

#include <cassert>

namespace patina {

at::Tensor to_tensor(const Image& image) {
  assert(image.channels == 3 && image.width == image.height);
  auto* pixels = const_cast<float*>(image.pixels.data());
  return at::from_blob(pixels, {image.height, image.width, 3}, at::kFloat).permute({2, 0, 1}).contiguous();
}

}  // namespace patina
