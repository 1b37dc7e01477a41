#include "engine/posterior/resampling.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/rand.h>
#include <gtest/gtest.h>

#include <utility>

#include "engine/io/photo.h"
#include "engine/summary/image_tensor.h"

namespace patina {
namespace {

TEST(Resampling, EqualsResizingBothWaysAtSizesThatDivideAndThatDoNot) {
  for (const auto& [from, to] : {std::pair{96, 48}, {100, 37}, {64, 16}, {50, 75}, {40, 40}}) {
    SCOPED_TRACE(testing::Message() << from << " to " << to);
    const Resampling resampling(to);
    for (int image = 0; image < 2; ++image) {  // the second time with weights that are kept
      const at::Tensor pixels = at::rand({3, from, from});
      const at::Tensor expected = to_tensor(resized(to_image(pixels), to));
      EXPECT_LT((resampling(pixels) - expected).abs().max().item<double>(), 3e-5);
    }
  }
}

TEST(Resampling, StaysWithinBlackAndWhiteWhereTheFilterWouldNot) {
  const at::Tensor edge = at::rand({3, 64, 64}).round();
  const at::Tensor small = Resampling(48)(edge);
  EXPECT_GE(small.min().item<float>(), 0);
  EXPECT_LE(small.max().item<float>(), 1);
  EXPECT_TRUE((small == 0).any().item<bool>() && (small == 1).any().item<bool>()) << "clamped nowhere";
}

}  // namespace
}  // namespace patina
