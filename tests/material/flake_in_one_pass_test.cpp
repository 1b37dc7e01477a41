#include <ATen/TensorOperators.h>
#include <ATen/ops/cat.h>
#include <ATen/ops/scalar_tensor.h>
#include <ATen/ops/tensor.h>
#include <gtest/gtest.h>

#include <vector>

#include "engine/material/flake_lobe.h"
#include "engine/material/flake_map.h"
#include "one_pass.h"

namespace patina {
namespace {

using Inputs = std::vector<at::Tensor>;

/// Normals and roughness as the planes of one field.
at::Tensor planes_of(const Lobe& lobe) { return at::cat({lobe.normal, lobe.roughness_x.unsqueeze(0)}); }

TEST(FlakeLobeInOnePass, EqualsTensorOperationsWithItsGradient) {
  const MipMap map = make_flake_map(3, 1, 64);
  const at::Tensor f0 = at::tensor({0.5, 0.5, 0.5});
  const auto lobe = [&](const auto& of, const Inputs& i) {
    return planes_of(of(map, {i[0], i[1], i[2]}, {i[3], i[4], f0}, 37));
  };
  // Map and flakes large and small; flat flakes and steep ones, dull and sharp.
  for (const double scale : {0.21, 0.93, 1.7, 30.0})
    for (const double ndf : {0.1, 0.9})
      for (const double rough : {0.15, 0.8}) {
        SCOPED_TRACE(testing::Message() << scale << ", " << ndf << ", " << rough);
        Inputs inputs;
        for (const double number : {scale, 0.37, -0.81, ndf, rough})
          inputs.push_back(at::scalar_tensor(number, at::kDouble));
        expect_same_by_scalars([&](const Inputs& i) { return lobe(flake_lobe, i); },
                               [&](const Inputs& i) { return lobe(flake_lobe_by_tensors, i); }, inputs);
      }
}

}  // namespace
}  // namespace patina
