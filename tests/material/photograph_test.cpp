// The passes over pixels against the same formulae as tensor operations.
#include "engine/material/photograph.h"

#include <ATen/Context.h>
#include <ATen/Parallel.h>
#include <ATen/TensorOperators.h>
#include <ATen/ops/rand.h>
#include <ATen/ops/randn.h>
#include <ATen/ops/randn_like.h>
#include <ATen/ops/tensor.h>
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "engine/material/heightfield.h"
#include "engine/material/shading.h"
#include "tests/material/materials_fixture.h"

namespace patina {
namespace {

double largest(const at::Tensor& difference) { return difference.abs().max().item<double>(); }

at::Tensor unit(const at::Tensor& vectors) { return vectors / vectors.square().sum(0).sqrt(); }

/// The lobes of surfaces: those that the kernel knows when it is compiled, named by who has them, and others.
enum class Kind { translucent, dielectric, metal, flake, any };
constexpr std::array kKinds{Kind::translucent, Kind::dielectric, Kind::metal, Kind::flake, Kind::any};

/// A surface on which nothing is constant that need not be: planes of every input, normals of their own, both
/// kinds of lobe, some pixels dark, some too bright.
struct Planes {
  static constexpr int n = 37;  // no multiple of a vector's length
  at::ScalarType type;
  std::vector<at::Tensor> leaves;

  explicit Planes(at::ScalarType t) : type(t) {}

  at::Tensor leaf(const at::Tensor& values) {
    leaves.push_back(values.to(at::kFloat).to(type).detach().clone().set_requires_grad(true));
    return leaves.back();
  }
  at::Tensor random_normal(double tilt) {
    const at::Tensor up = at::tensor({0.0, 0.0, 1.0}, at::kDouble).view({3, 1, 1});
    return unit(up + tilt * at::randn({3, n, n}, at::kDouble));
  }
  at::Tensor number(double value) { return leaf(at::tensor(value, at::kDouble)); }
  at::Tensor colour() { return leaf(at::rand({3}, at::kDouble) * 0.5); }
  at::Tensor roughness() { return leaf(at::rand({n, n}, at::kDouble) * 0.5 + 0.25); }

  Surface make(Kind kind = Kind::any) {
    at::manual_seed(5);
    Surface surface;
    surface.light = number(4000);
    surface.vignette_sigma = number(9);
    if (kind == Kind::translucent) {
      // What is the same everywhere, or in all channels, is held once.
      surface.base_color = leaf(at::rand({n, n}, at::kDouble)).expand({3, n, n});
      surface.normal = leaf(at::tensor({0.0, 0.0, 1.0}, at::kDouble).view({3, 1, 1})).expand({3, n, n});
      return surface;
    }
    surface.base_color = leaf(at::rand({3, n, n}, at::kDouble).square());
    surface.normal = leaf(random_normal(0.4));
    if (kind == Kind::metal) {
      surface.lobes = {{surface.normal, colour(), roughness(), roughness()}};
      return surface;
    }
    const at::Tensor shared = kind == Kind::flake ? number(0.3) : roughness();
    surface.lobes = {{surface.normal, leaf(at::tensor({0.04}, at::kDouble)), shared, shared}};
    if (kind == Kind::dielectric) return surface;
    const at::Tensor second = roughness();
    surface.lobes.push_back(
        {leaf(random_normal(0.2)), colour(), second, kind == Kind::flake ? second : roughness()});
    const at::Tensor last = number(0.4);
    if (kind == Kind::flake)
      surface.lobes.push_back({surface.normal, colour(), last, last});
    else
      surface.lobes.push_back({leaf(random_normal(0.1)), leaf(at::rand({3, n, n}, at::kDouble)), last, last});
    return surface;
  }
};

TEST(Photograph, EqualsShadingByTensorOperations) {
  for (const DisplayCurve curve : {DisplayCurve::srgb, DisplayCurve::gamma22})
    for (const Kind kind : kKinds) {
      SCOPED_TRACE(static_cast<int>(kind));
      Planes fast(at::kFloat), precise(at::kDouble);
      const at::Tensor once = photograph(fast.make(kind), Capture{}, Planes::n, curve);
      const at::Tensor again = display(shade(precise.make(kind), Capture{}, Planes::n), curve);
      EXPECT_LT(largest(once - again), 4e-5);  // a hundredth of a level; float32 tensors are off by 1.5e-5
      EXPECT_GT(again.std().item<double>(), 0.1);  // neither black nor white
      EXPECT_GT((again > 0.9999).sum().item<int>(), 10);
    }
}

TEST(Photograph, HasTheGradientThatDifferentiatingTensorOperationsGives) {
  at::manual_seed(4);
  const at::Tensor weights = at::rand({3, Planes::n, Planes::n}, at::kDouble);  // sums that do not cancel
  for (const Kind kind : kKinds) {
    SCOPED_TRACE(static_cast<int>(kind));
    Planes fast(at::kFloat), precise(at::kDouble);
    (photograph(fast.make(kind), Capture{}, Planes::n, DisplayCurve::srgb) * weights.to(at::kFloat))
        .sum()
        .backward();
    (display(shade(precise.make(kind), Capture{}, Planes::n), DisplayCurve::srgb) * weights).sum().backward();
    ASSERT_EQ(fast.leaves.size(), precise.leaves.size());
    for (std::size_t i = 0; i < fast.leaves.size(); ++i) {
      const at::Tensor &once = fast.leaves[i].grad(), &again = precise.leaves[i].grad();
      EXPECT_GT(largest(again), 0) << i;
      EXPECT_LT(largest(once - again), 2e-4 * largest(again)) << i;
    }
  }
}

TEST(Photograph, BuildsNoGraphForWhatAsksForNoGradient) {
  Planes planes(at::kFloat);
  Surface surface = planes.make();
  for (at::Tensor& leaf : planes.leaves) leaf.set_requires_grad(false);
  EXPECT_FALSE(photograph(surface, Capture{}, Planes::n, DisplayCurve::srgb).requires_grad());
  surface.light.set_requires_grad(true);
  photograph(surface, Capture{}, Planes::n, DisplayCurve::srgb).sum().backward();
  EXPECT_TRUE(surface.light.grad().defined());
  EXPECT_FALSE(surface.normal.grad().defined());
}

TEST(Photograph, EqualsItselfOnAnyNumberOfThreads) {
  const auto bump = make_material("bump");
  std::mt19937 random(3);
  const std::vector<double> at = inside_box(bump->table(), random);
  const auto gradient = [&](int threads) {
    const int before = at::get_num_threads();
    at::set_num_threads(threads);
    const at::Tensor position = tensor_of(at, at::kFloat).set_requires_grad(true);
    photograph(bump->surface(position, {}, shared_irregularities(), Capture{}, 200), Capture{}, 200,
               DisplayCurve::srgb)
        .mean()
        .backward();
    at::set_num_threads(before);
    return position.grad();
  };
  // The heightfield's transform is the library's, which may add up in another order.
  EXPECT_LT(largest((gradient(1) - gradient(2)) / gradient(1)), 1e-4);
}

using NormalsOf = at::Tensor (*)(const at::Tensor& height, double pixel_cm);

/// That both ways give the same normals of a side x side heightfield, and the same gradients.
void expect_equal(NormalsOf in_one_pass, NormalsOf by_tensors, std::int64_t side) {
  const at::Tensor height = at::randn({side, side}, at::kDouble) * 0.05;
  const at::Tensor fast = height.to(at::kFloat).set_requires_grad(true);
  const at::Tensor precise = height.clone().set_requires_grad(true);
  const at::Tensor once = in_one_pass(fast, 0.11), again = by_tensors(precise, 0.11);
  ASSERT_EQ(once.sizes(), again.sizes());
  EXPECT_LT(largest(once - again), 1e-6);
  const at::Tensor weights = at::randn_like(again);
  (once * weights.to(at::kFloat)).sum().backward();
  (again * weights).sum().backward();
  EXPECT_LT(largest(fast.grad() - precise.grad()), 1e-5 * largest(precise.grad()));
}

TEST(Normals, InOnePassEqualThoseByTensorOperationsAndSoDoTheirGradients) {
  at::manual_seed(2);
  for (const std::int64_t n : {2, 16, 33}) {
    expect_equal(open_normals, open_normals_by_tensors, n + 1);
    expect_equal(heightfield_normals, heightfield_normals_by_tensors, n);
  }
}

}  // namespace
}  // namespace patina
