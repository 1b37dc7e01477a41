#include <ATen/TensorOperators.h>
#include <ATen/ops/cat.h>
#include <ATen/ops/full.h>
#include <ATen/ops/stack.h>
#include <ATen/ops/tensor.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "engine/material/leather_finish.h"
#include "one_pass.h"

namespace patina {
namespace {

using Inputs = std::vector<at::Tensor>;

/// Inputs: height and power, noise_scale, roughness and its variation, maps. One field of all that comes of
/// them.
template <class F>
at::Tensor finish_of(const F& of, const Inputs& i) {
  const LeatherFinish made = of(LeatherRelief{i[0][0], i[0][1], i[0][2], i[0][3], i[0][4]}, i[1]);
  return at::cat({made.height.flatten(), made.roughness.flatten()});
}

/// Cells from 0.14 to 1, and noise.
at::Tensor maps() {
  const auto square = [](const at::Tensor& wave) {
    return wave.flatten().narrow(0, 0, 38 * 38).view({38, 38});
  };
  return at::stack(
      {square(places(0.37, 0).sin().square() * 0.86 + 0.14), square(places(0.11, 1).cos().square())});
}

TEST(LeatherInOnePass, EqualsTensorOperationsWithItsGradient) {
  // A relief and a roughness that are cut off nowhere, and ones that are at either end.
  for (const at::Tensor& relief : {at::tensor({0.21, 0.7, 0.04, 0.31, 0.27}, at::kDouble),
                                   at::tensor({1.4, 2.3, 0.3, 0.61, 0.57}, at::kDouble),
                                   at::tensor({0.9, 1.6, 0.1, 0.21, -0.43}, at::kDouble)})
    expect_same([](const Inputs& i) { return finish_of(leather_finish, i); },
                [](const Inputs& i) { return finish_of(leather_finish_by_tensors, i); }, {relief, maps()});
}

TEST(LeatherInOnePass, OfAPlaceThatIsNoNumberIsNone) {
  const at::Tensor one = at::full({}, 1.0F);
  const at::Tensor nowhere = at::full({2, 3, 3}, std::numeric_limits<float>::quiet_NaN());
  EXPECT_TRUE(leather_finish({one, one, one, one, one}, nowhere).height.isnan().all().item<bool>());
}

}  // namespace
}  // namespace patina
