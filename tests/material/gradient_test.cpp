#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <gtest/gtest.h>

#include <cmath>

#include "materials_fixture.h"

namespace patina {
namespace {

constexpr int kResolution = 48;

/// A smooth functional of an image that no symmetry of the capture can hide a parameter from.
at::Tensor functional(const at::Tensor& image) {
  const at::Tensor weights =
      (at::arange(image.numel(), image.options().requires_grad(false)) * 0.37).sin().view(image.sizes()) +
      0.5;
  return (image.square() * weights).mean();
}

at::Tensor value(const Material& material, const std::vector<double>& at, at::ScalarType type) {
  const std::vector<int> discrete(material.table().discrete.size(), 1);
  return functional(render(material, tensor_of(at, type), discrete, kResolution));
}

at::Tensor gradient(const Material& material, const std::vector<double>& at, at::ScalarType type) {
  const std::vector<int> discrete(material.table().discrete.size(), 1);
  const at::Tensor parameters = tensor_of(at, type).set_requires_grad(true);
  functional(render(material, parameters, discrete, kResolution)).backward();
  return parameters.grad().to(at::kDouble);
}

class EveryMaterial : public testing::TestWithParam<std::string> {
 protected:
  std::shared_ptr<const Material> material = make_material(GetParam());
  std::mt19937 random{5};
};

TEST_P(EveryMaterial, GradientAgreesWithCentralDifferencesOfEveryParameter) {
  for (int point = 0; point < 3; ++point) {
    const std::vector<double> at = inside_box(material->table(), random);
    const at::Tensor analytic = gradient(*material, at, at::kDouble);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const Parameter& parameter = material->table().continuous[i];
      const double width = parameter.prior.high - parameter.prior.low, step = 1e-8 * width;
      std::vector<double> above = at, below = at;
      above[i] += step;
      below[i] -= step;
      const double difference =
          (value(*material, above, at::kDouble) - value(*material, below, at::kDouble)).item<double>() /
          (2 * step);
      const double expected = analytic[static_cast<std::int64_t>(i)].item<double>();
      // Bilinear look-up and clamps have kinks: a few pixels in a million cross one within a step.
      EXPECT_NEAR(difference, expected, 2e-3 * std::abs(expected) + 1e-6 / width) << parameter.name;
      EXPECT_NE(expected, 0) << parameter.name << " does nothing";
    }
  }
}

TEST_P(EveryMaterial, SinglePrecisionGradientAgreesWithDouble) {
  for (int point = 0; point < 5; ++point) {
    const std::vector<double> at = inside_box(material->table(), random);
    const at::Tensor precise = gradient(*material, at, at::kDouble),
                     fast = gradient(*material, at, at::kFloat);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const auto k = static_cast<std::int64_t>(i);
      const Parameter& parameter = material->table().continuous[i];
      const double width = parameter.prior.high - parameter.prior.low;
      EXPECT_NEAR(fast[k].item<double>(), precise[k].item<double>(),
                  2e-3 * std::abs(precise[k].item<double>()) + 1e-4 / width)
          << parameter.name;
    }
  }
}

TEST_P(EveryMaterial, ValueAndGradientAreFiniteAtEveryCornerTried) {
  const auto& parameters = material->table().continuous;
  const std::vector<int> discrete(material->table().discrete.size(), 0);
  for (unsigned corner = 0; corner < 40; ++corner) {
    std::vector<double> at;
    for (const Parameter& parameter : parameters) {
      const bool high = corner == 1 || (corner > 1 && random() % 2 == 1);
      at.push_back(high ? parameter.prior.high : parameter.prior.low);
    }
    for (const DisplayCurve curve : {DisplayCurve::srgb, DisplayCurve::gamma22}) {
      const at::Tensor position = tensor_of(at, at::kFloat).set_requires_grad(true);
      const at::Tensor image = render(*material, position, discrete, kResolution, curve);
      EXPECT_GE(image.min().item<float>(), 0);
      EXPECT_LE(image.max().item<float>(), 1);
      EXPECT_TRUE(image.isfinite().all().item<bool>());
      functional(image).backward();
      EXPECT_TRUE(position.grad().isfinite().all().item<bool>()) << "corner " << corner;
    }
  }
}

TEST_P(EveryMaterial, SameSeedGivesTheSameSurfaceAndAnotherSeedAnother) {
  const std::vector<double> at = prior_location(material->table()).continuous;
  const std::vector<int> discrete(material->table().discrete.size(), 0);
  const auto slopes = [&](std::uint64_t seed) {
    const Surface surface =
        material->surface(tensor_of(at, at::kFloat), discrete, Irregularities(seed), Capture{}, 64);
    // The lobe that is not flat, where there is one.
    const at::Tensor normal = surface.lobes.size() > 1 ? surface.lobes[1].normal : surface.normal;
    return normal.narrow(0, 0, 2).contiguous();
  };
  const at::Tensor once = slopes(3), again = slopes(3), other = slopes(4);
  EXPECT_TRUE(once.equal(again));
  if (GetParam() == "translucent") return;  // homogeneous
  const at::Tensor a = once - once.mean(), b = other - other.mean();
  const double correlation = ((a * b).mean() / (a.square().mean() * b.square().mean()).sqrt()).item<double>();
  EXPECT_LT(std::abs(correlation), 0.2);
}

INSTANTIATE_TEST_SUITE_P(Materials, EveryMaterial, testing::ValuesIn(material_names()),
                         [](const auto& info) { return info.param; });

TEST(Leather, EveryChoiceOfCellsAndNoiseChangesTheSurface) {
  const auto leather = make_material("leather");
  const at::Tensor at = tensor_of(prior_location(leather->table()).continuous, at::kFloat);
  std::vector<at::Tensor> heights;
  for (const std::vector<int>& discrete : {std::vector{0, 0}, {1, 0}, {2, 0}, {0, 1}, {0, 2}, {2, 1}})
    heights.push_back(leather->surface(at, discrete, shared_irregularities(), Capture{}, 64).height);
  for (std::size_t i = 0; i < heights.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT((heights[i] - heights[j]).abs().mean().item<double>(), 1e-3) << i << ", " << j;
}

}  // namespace
}  // namespace patina
