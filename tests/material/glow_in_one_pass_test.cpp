#include <ATen/TensorOperators.h>
#include <gtest/gtest.h>

#include "engine/material/capture_view.h"
#include "engine/material/glow.h"
#include "engine/material/subsurface.h"
#include "materials_fixture.h"
#include "one_pass.h"

namespace patina {
namespace {

const Medium kWax{tensor_of({2.0}, at::kDouble)[0], tensor_of({0.02}, at::kDouble)[0],
                  tensor_of({0.3}, at::kDouble)[0]};

at::Tensor exitance(const at::Tensor& distance) {
  return multiple_scattering(kWax, distance) + single_scattering(kWax, distance);
}

TEST(GlowInOnePass, EqualsTensorOperationsWithItsGradient) {
  for (const int n : {16, 37, 64}) {  // with a middle row and column, and without
    SCOPED_TRACE(n);
    const Capture capture{.size_cm = n == 37 ? 4.0 : 10.0, .camera_cm = 20};
    const at::Tensor log2_exitance = exitance(glow_rings(capture, n, at::kDouble)).log2();
    expect_same([&](const auto& i) { return glow_color(i[0], capture, n); },
                [&](const auto& i) { return glow_color_by_tensors(i[0], capture, n); }, {log2_exitance});
  }
}

TEST(GlowInOnePass, IsWhatLeavesAtEveryPixelOverTheFlash) {
  const Capture capture;
  constexpr int kSide = 32;
  const at::Tensor log2_exitance = exitance(glow_rings(capture, kSide, at::kDouble)).log2();
  const CaptureView view = capture_view(capture, kSide, at::kDouble);
  const at::Tensor distance = (view.square_radius + 0.01).sqrt().flatten();
  const at::Tensor expected =
      exitance(distance).view({kSide, kSide}) / (view.direction[2] * view.inverse_square_distance);
  EXPECT_LT((glow_color(log2_exitance, capture, kSide) / expected - 1).abs().max().item<double>(), 1e-3);
}

}  // namespace
}  // namespace patina
