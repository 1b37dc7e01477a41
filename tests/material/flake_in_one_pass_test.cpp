#include <ATen/TensorOperators.h>
#include <ATen/ops/cat.h>
#include <ATen/ops/stack.h>
#include <ATen/ops/tensor.h>
#include <gtest/gtest.h>

#include <vector>

#include "engine/material/flake_lobe.h"
#include "one_pass.h"

namespace patina {
namespace {

using Inputs = std::vector<at::Tensor>;

/// Normals and roughness as the planes of one field.
at::Tensor planes_of(const Lobe& lobe) { return at::cat({lobe.normal, lobe.roughness_x.unsqueeze(0)}); }

TEST(FlakeLobeInOnePass, EqualsTensorOperationsWithItsGradient) {
  const at::Tensor f0 = at::tensor({0.5, 0.5, 0.5});
  // Flat flakes and steep ones, dull and sharp; no spread at all in places.
  const at::Tensor flakes =
      at::stack({places(0.61, 0).sin(), places(0.17, 1).cos() * 2, places(0.05, 2).sin().clamp_min(0)});
  for (const double ndf : {0.1, 0.9})
    for (const double rough : {0.15, 0.8}) {
      SCOPED_TRACE(testing::Message() << ndf << ", " << rough);
      expect_same([&](const Inputs& i) { return planes_of(flake_lobe(i[0], i[1], i[2], f0)); },
                  [&](const Inputs& i) { return planes_of(flake_lobe_by_tensors(i[0], i[1], i[2], f0)); },
                  {flakes, at::tensor(ndf), at::tensor(rough)});
    }
}

}  // namespace
}  // namespace patina
