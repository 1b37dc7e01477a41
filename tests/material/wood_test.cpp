#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <ATen/ops/clamp.h>
#include <ATen/ops/full_like.h>
#include <ATen/ops/minimum.h>
#include <ATen/ops/zeros.h>
#include <ATen/ops/zeros_like.h>
#include <gtest/gtest.h>

#include "engine/material/growth_rings.h"
#include "engine/material/value_noise.h"
#include "materials_fixture.h"

namespace patina {
namespace {

at::Tensor scalar(double x) { return at::tensor(x, at::kDouble); }

RingProfile profile(double earlywood_ramp, double latewood_ramp, double latewood_fraction) {
  return {scalar(earlywood_ramp), scalar(latewood_ramp), scalar(latewood_fraction)};
}

// Usual, with ramps that meet before the top, with a jump where a ring begins, and with both.
const std::vector<RingProfile>& profiles() {
  static const std::vector<RingProfile> all{profile(0.2, 0.2, 0.5), profile(0.4, 0.1, 0.1),
                                            profile(0.2, 0.4, 0.9), profile(0.4, 0.4, 0.35),
                                            profile(0.01, 0.01, 0.5)};
  return all;
}

/// models.md's formula, as it stands.
at::Tensor textbook_ratio(const RingProfile& profile, const at::Tensor& rings) {
  const at::Tensor t = rings - rings.floor();
  return at::clamp(
      at::minimum(t / profile.earlywood_ramp, (profile.latewood_fraction - t) / profile.latewood_ramp + 1), 0,
      1);
}

TEST(LatewoodRatio, OfANarrowPixelIsTheTextbookFormula) {
  const at::Tensor rings = (at::arange(1000, at::kDouble) * 0.00731 - 1.997).view({1, -1});
  for (const RingProfile& p : profiles()) {
    const at::Tensor ratio = latewood_ratio(p, rings, at::full_like(rings, 1e-6));
    EXPECT_LT((ratio - textbook_ratio(p, rings)).abs().max().item<double>(), 1e-3);
  }
}

TEST(LatewoodRatio, OfAWidePixelIsTheMeanOfTheFormulaOverIt) {
  const at::Tensor rings = (at::arange(40, at::kDouble) * 0.173 - 2).view({-1, 1});
  const std::int64_t samples = 20000;
  const at::Tensor place = (at::arange(samples, at::kDouble).view({1, -1}) + 0.5) / samples - 0.5;
  for (const RingProfile& p : profiles())
    for (const double width : {0.05, 0.3, 0.5}) {
      const at::Tensor mean = textbook_ratio(p, rings + place * width).mean(1, true);
      const at::Tensor ratio = latewood_ratio(p, rings, at::full_like(rings, width));
      EXPECT_LT((ratio - mean).abs().max().item<double>(), 1e-4) << width;
    }
}

TEST(LatewoodRatio, OfAPixelOfARingOrMoreIsTheMeanOfARing) {
  const at::Tensor rings = (at::arange(40, at::kDouble) * 0.173 - 2).view({-1, 1});
  const at::Tensor ring = (at::arange(20000, at::kDouble).view({1, -1}) + 0.5) / 20000;
  for (const RingProfile& p : profiles())
    for (const double width : {1.0, 2.7}) {
      const at::Tensor ratio = latewood_ratio(p, rings, at::full_like(rings, width));
      EXPECT_LT((ratio - textbook_ratio(p, ring).mean()).abs().max().item<double>(), 1e-4) << width;
    }
}

TEST(LatewoodRatio, IsContinuousWhereTheFormulaJumps) {
  const RingProfile jumping = profile(0.2, 0.4, 0.9);
  const at::Tensor here = at::arange(1, 200, at::kDouble).view({1, -1}) / 50,
                   width = at::full_like(here, 0.1);
  const auto step = [&](const auto& ratio) { return (ratio(here + 1e-9) - ratio(here - 1e-9)).abs().max(); };
  EXPECT_LT(step([&](const at::Tensor& r) { return latewood_ratio(jumping, r, width); }).item<double>(),
            1e-6);
  EXPECT_GT(step([&](const at::Tensor& r) { return textbook_ratio(jumping, r); }).item<double>(), 0.1);
}

TEST(RingWidths, OfAPlaneAreTheLengthOfItsGradient) {
  const at::Tensor k = at::arange(9, at::kDouble);
  const at::Tensor widths = ring_widths(k.view({-1, 1}) * 0.3 - k.view({1, -1}) * 0.4);
  EXPECT_LT((widths - 0.5).abs().max().item<double>(), 1e-5);
}

TEST(RingWidths, RepeatTheStepBeforeAtTheLastColumnAndRow) {
  const at::Tensor k = at::arange(5, at::kDouble);
  const at::Tensor widths = ring_widths(k.square().view({-1, 1}) + at::zeros({5, 5}, at::kDouble));
  EXPECT_NEAR(widths[3][0].item<double>(), 7, 1e-6);
  EXPECT_NEAR(widths[4][4].item<double>(), 7, 1e-6);
}

class ValueNoiseTest : public testing::Test {
 protected:
  at::Tensor seen(double x, double y, double width_x, double width_y) const {
    const at::Tensor k = at::arange(300, at::kDouble) * 0.217;
    return value_noise(noise, (k + x).view({1, -1}), (k * 1.3 + y).view({1, -1}), scalar(width_x),
                       scalar(width_y));
  }
  const ValueNoise noise = make_value_noise(3, 1, 32, 32);
};

TEST_F(ValueNoiseTest, IsUniformAtWholeCoordinatesLinearBetweenAndPeriodic) {
  const at::Tensor all = noise.levels[0][0];
  EXPECT_NEAR(all.mean().item<double>(), 0.5, 0.03);
  EXPECT_NEAR(all.var().item<double>(), 1.0 / 12, 0.01);
  const auto at = [&](double x, double y) {
    return value_noise(noise, scalar(x).view({1, 1}), scalar(y).view({1, 1}), scalar(0.1), scalar(0.1))
        .item<double>();
  };
  EXPECT_NEAR(at(3, 5), all[0][0][5][3].item<double>(), 1e-6);
  EXPECT_NEAR(at(3.25, 5), 0.75 * at(3, 5) + 0.25 * at(4, 5), 1e-6);
  EXPECT_NEAR(at(3, 5.5), 0.5 * at(3, 5) + 0.5 * at(3, 6), 1e-6);
  EXPECT_LT((seen(0, 0, 0.1, 0.1) - seen(64, -32, 0.1, 0.1)).abs().max().item<double>(), 1e-6);
}

TEST_F(ValueNoiseTest, OfWidePixelsIsNearlyItsMeanOverThem) {
  for (const auto& [width_x, width_y] : {std::pair{4.0, 0.5}, {0.5, 4.0}, {4.0, 4.0}, {11.0, 0.1}}) {
    at::Tensor mean = at::zeros_like(seen(0, 0, 1, 1));
    constexpr int kSteps = 40;
    for (int i = 0; i < kSteps; ++i)
      for (int j = 0; j < kSteps; ++j)
        mean += seen(((i + 0.5) / kSteps - 0.5) * width_x, ((j + 0.5) / kSteps - 0.5) * width_y, 0.1, 0.1) /
                (kSteps * kSteps);
    const at::Tensor filtered = seen(0, 0, width_x, width_y), sharp = seen(0, 0, 0.1, 0.1);
    const double error = (filtered - mean).square().mean().item<double>();
    EXPECT_LT(error, 0.1 * (sharp - mean).square().mean().item<double>()) << width_x << " x " << width_y;
  }
}

TEST_F(ValueNoiseTest, GoesOverFromWidthToWidthWithoutAJump) {
  for (const double level : {0, 1, 2, 3, 4, 5}) {
    const double width = std::exp2(level + 0.5);
    const at::Tensor below = seen(0, 0, width * (1 - 1e-9), 0.7), above = seen(0, 0, width * (1 + 1e-9), 0.7);
    EXPECT_LT((below - above).abs().max().item<double>(), 1e-6) << level;
  }
}

}  // namespace
}  // namespace patina
