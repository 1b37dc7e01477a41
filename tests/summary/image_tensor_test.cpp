#include "engine/summary/image_tensor.h"

#include <ATen/ops/arange.h>
#include <gtest/gtest.h>

namespace patina {
namespace {

TEST(ImageTensor, AnImageComesBackFromItsPlanesAndEachPlaneIsAChannel) {
  constexpr int kSide = 4;
  Image image(kSide, kSide, 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<float>(i);
  const at::Tensor planes = to_tensor(image);
  EXPECT_EQ(planes[2][1][3].item<float>(), image.pixels[(1 * kSide + 3) * 3 + 2]);
  EXPECT_EQ(to_image(planes).pixels, image.pixels);
}

TEST(ImageTensor, PlanesMayBeWiderThanHigh) {
  const Image image = to_image(at::arange(3 * 2 * 5, at::kFloat).view({3, 2, 5}));
  EXPECT_EQ(image.width, 5);
  EXPECT_EQ(image.height, 2);
  EXPECT_EQ(image.pixels[(1 * 5 + 4) * 3 + 1], 19);  // the last of the second plane
}

}  // namespace
}  // namespace patina
