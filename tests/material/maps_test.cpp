#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <ATen/ops/avg_pool2d.h>
#include <ATen/ops/fft_fft2.h>
#include <ATen/ops/max_pool2d.h>
#include <ATen/ops/quantile.h>
#include <ATen/ops/tensor.h>
#include <ATen/ops/where.h>
#include <c10/core/InferenceMode.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <thread>

#include "engine/material/look_up.h"
#include "engine/material/shading.h"
#include "materials_fixture.h"

namespace patina {
namespace {

constexpr int kSize = Irregularities::kMapSize;

at::Tensor inside(const at::Tensor& map) { return map[0][0].narrow(0, 1, kSize).narrow(1, 1, kSize); }

/// Share of a map's variance in [low, high) cycles per map.
double band_share(const at::Tensor& map, double low, double high) {
  const at::Tensor power = at::fft_fft2(map - map.mean()).abs().square();
  const at::Tensor k = at::arange(kSize, at::kFloat);
  const at::Tensor f = at::where(k < kSize / 2, k, k - kSize).square();
  const at::Tensor radius = (f.view({-1, 1}) + f.view({1, -1})).sqrt();
  return (power * ((radius >= low) * (radius < high))).sum().item<double>() / power.sum().item<double>();
}

void expect_quantiles(const at::Tensor& map, const std::array<double, 5>& expected) {
  // Every 16th texel: at::quantile takes no more than 16 million, and sorts them all.
  const at::Tensor some = map.flatten().slice(0, 0, c10::nullopt, 16).contiguous();
  const std::array<double, 5> probability{0.05, 0.25, 0.5, 0.75, 0.95};
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(at::quantile(some, probability[i]).item<double>(), expected[i], 0.02) << probability[i];
}

TEST(NoiseMap, HasTheStatisticsOfThePapersNoise) {
  for (int choice = 0; choice < Irregularities::kMapChoices; ++choice) {
    const at::Tensor map = inside(shared_irregularities().noise(choice).finest());
    EXPECT_NEAR(map.mean().item<double>(), 0.365, 0.02);
    EXPECT_NEAR(map.std().item<double>(), 0.161, 0.02);
    expect_quantiles(map, {0.13, 0.25, 0.35, 0.47, 0.65});
    const std::array<double, 9> octaves{.17, .23, .13, .11, .11, .10, .09, .05, .01};
    for (std::size_t i = 0; i < octaves.size(); ++i) {
      // The first octaves are a dozen waves, whose interference is left to chance.
      const double tolerance = i < 3 ? 0.05 : 0.02;
      EXPECT_NEAR(band_share(map, std::exp2(i), std::exp2(i + 1)), octaves[i], tolerance) << "octave " << i;
    }
  }
}

TEST(CellMap, HasTheStatisticsOfThePapersCells) {
  for (int choice = 0; choice < Irregularities::kMapChoices; ++choice) {
    const at::Tensor map = inside(shared_irregularities().cells(choice).finest());
    EXPECT_NEAR(map.mean().item<double>(), 0.52, 0.02);
    EXPECT_NEAR(map.std().item<double>(), 0.24, 0.02);
    expect_quantiles(map, {0.21, 0.34, 0.47, 0.71, 0.96});
    EXPECT_GT(band_share(map, 32, 128), 0.6);
    EXPECT_GT(map.min().item<double>(), 0.1);  // leather takes its logarithm
  }
}

TEST(CellMap, HasSomeThousandsOfPeaks) {
  const at::Tensor cells = shared_irregularities().cells(0).finest();
  // A cell's flat top is one peak: of two equal texels the later one is taken for the higher.
  const at::Tensor map =
      cells.to(at::kDouble) + 1e-12 * at::arange(cells.numel(), at::kDouble).view(cells.sizes());
  const at::Tensor highest = at::max_pool2d(map, {9, 9}, {1, 1}, {4, 4});
  const auto peaks = (map == highest).sum().item<std::int64_t>();
  EXPECT_GT(peaks, 2500);
  EXPECT_LT(peaks, 5000);
}

class EveryMap : public testing::TestWithParam<bool> {
 protected:
  at::Tensor map(const Irregularities& z, int choice) const {
    return (GetParam() ? z.cells(choice) : z.noise(choice)).finest();
  }
};

TEST_P(EveryMap, LiesInTheUnitInterval) {
  const at::Tensor values = map(shared_irregularities(), 0);
  EXPECT_GE(values.min().item<float>(), 0);
  EXPECT_LE(values.max().item<float>(), 1);
}

TEST_P(EveryMap, BorderRepeatsTheOppositeSide) {
  const at::Tensor values = map(shared_irregularities(), 0)[0][0];
  EXPECT_TRUE(values.select(0, 0).equal(values.select(0, kSize)));
  EXPECT_TRUE(values.select(0, kSize + 1).equal(values.select(0, 1)));
  EXPECT_TRUE(values.select(1, 0).equal(values.select(1, kSize)));
  EXPECT_TRUE(values.select(1, kSize + 1).equal(values.select(1, 1)));
}

TEST_P(EveryMap, IsAsSmoothAcrossTheSeamAsElsewhere) {
  const at::Tensor values = map(shared_irregularities(), 0)[0][0];
  for (const int dim : {0, 1}) {
    const at::Tensor steps = (values.narrow(dim, 1, kSize + 1) - values.narrow(dim, 0, kSize + 1)).abs();
    const double seam = steps.select(dim, 0).mean().item<double>(), typical = steps.mean().item<double>();
    EXPECT_NEAR(seam / typical, 1, 0.3);
  }
}

TEST_P(EveryMap, IsAFunctionOfSeedAndChoiceAlone) {
  const Irregularities same(11), other(12);
  const at::Tensor first = inside(map(shared_irregularities(), 0));
  EXPECT_TRUE(first.equal(inside(map(same, 0))));
  const auto correlation = [&](const at::Tensor& second) {
    const at::Tensor a = first - first.mean(), b = second - second.mean();
    return ((a * b).mean() / (a.std() * b.std())).item<double>();
  };
  EXPECT_NEAR(correlation(first), 1, 1e-3);
  // Noise has most of its energy in a few waves, which leaves chance some room.
  EXPECT_NEAR(correlation(inside(map(other, 0))), 0, 0.3);
  EXPECT_NEAR(correlation(inside(map(shared_irregularities(), 1))), 0, 0.3);
}

INSTANTIATE_TEST_SUITE_P(Maps, EveryMap, testing::Bool(),
                         [](const auto& info) { return info.param ? "Cells" : "Noise"; });

class LookUp : public testing::Test {
 protected:
  at::Tensor at_scale(double scale, double shift_x, double shift_y, int resolution) const {
    const auto scalar = [](double x) { return at::tensor(x, at::kDouble); };
    return without_neighbours(look_up(map, scalar(scale), scalar(shift_x), scalar(shift_y), resolution)[0]);
  }
  MipMap map = shared_irregularities().cells(0);
};

TEST_F(LookUp, AtTexelCentresIsTheMap) {
  EXPECT_LT((at_scale(1, 0, 0, kSize) - inside(map.finest())).abs().max().item<double>(), 1e-6);
}

TEST_F(LookUp, HalfTheScaleShowsTheMiddleHalf) {
  const at::Tensor middle =
      inside(map.finest()).narrow(0, kSize / 4, kSize / 2).narrow(1, kSize / 4, kSize / 2);
  EXPECT_LT((at_scale(0.5, 0, 0, kSize / 2) - middle).abs().max().item<double>(), 1e-6);
}

TEST_F(LookUp, PositiveShiftMovesTheWindowRightAndDown) {
  const double texel = 2.0 / kSize;
  const at::Tensor moved = at_scale(1, 3 * texel, 5 * texel, kSize);
  const at::Tensor expected = inside(map.finest()).roll({-5, -3}, {0, 1});
  EXPECT_LT((moved - expected).abs().max().item<double>(), 1e-6);
}

TEST_F(LookUp, BringsTheNeighboursAboveAndToTheRight) {
  const auto scalar = [](double x) { return at::tensor(x, at::kDouble); };
  const double pixel = 2.0 / 200;
  const at::Tensor extended = look_up(map, scalar(0.7), scalar(0.1), scalar(0.2), 200)[0];
  const at::Tensor above = at_scale(0.7, 0.1, 0.2 - pixel, 200), right = at_scale(0.7, 0.1 + pixel, 0.2, 200);
  EXPECT_LT((extended.narrow(0, 0, 200).narrow(1, 0, 200) - above).abs().max().item<double>(), 1e-9);
  EXPECT_LT((extended.narrow(0, 1, 200).narrow(1, 1, 200) - right).abs().max().item<double>(), 1e-9);
}

TEST_F(LookUp, RepeatsAfterAWholeMap) {
  const at::Tensor here = at_scale(0.7, 0.123, 0.456, 200);
  const at::Tensor there = at_scale(0.7, 0.123 + 2 / 0.7, 0.456 - 2 / 0.7, 200);
  EXPECT_LT((here - there).abs().max().item<double>(), 1e-9);
}

TEST_F(LookUp, BetweenTexelsIsLinear) {
  const double texel = 2.0 / kSize;
  const at::Tensor between = at_scale(1, 0.25 * texel, 0, kSize);
  const at::Tensor expected = inside(map.finest()) * 0.75 + inside(map.finest()).roll({-1}, {1}) * 0.25;
  EXPECT_LT((between - expected).abs().max().item<double>(), 1e-6);
}

TEST_F(LookUp, OfPixelsWiderThanTexelsAveragesThem) {
  for (const int texels_per_pixel : {2, 4, 16}) {
    const at::Tensor seen = at_scale(1, 0, 0, kSize / texels_per_pixel);
    const at::Tensor averaged =
        at::avg_pool2d(inside(map.finest()).unsqueeze(0), {texels_per_pixel, texels_per_pixel})[0];
    EXPECT_LT((seen - averaged).abs().max().item<double>(), 1e-5) << texels_per_pixel;
  }
}

TEST_F(LookUp, GoesOverFromLevelToLevelWithoutAJump) {
  for (const double scale : {0.5, 1.0})
    for (const int resolution : {64, 256}) {
      const at::Tensor below = at_scale(scale * (1 - 1e-7), 0, 0, resolution),
                       above = at_scale(scale * (1 + 1e-7), 0, 0, resolution);
      EXPECT_LT((below - above).abs().max().item<double>(), 1e-4) << scale << " at " << resolution;
    }
}

// The reason for the levels: between two pixels lies little more detail than a straight line shows.
TEST_F(LookUp, ShiftedByHalfAPixelIsNearlyWhatInterpolationGives) {
  const int resolution = 64;
  const double pixel = 2.0 / resolution;
  const auto surprise = [&] {
    const at::Tensor here = at_scale(1, 0, 0, resolution), next = at_scale(1, pixel, 0, resolution);
    return (at_scale(1, pixel / 2, 0, resolution) - (here + next) / 2).square().mean().item<double>();
  };
  const double filtered = surprise();
  map.levels.resize(1);
  const double point_sampled = surprise();
  EXPECT_LT(filtered, 0.05 * point_sampled);
}

TEST(Irregularities, MadeInInferenceModeStillServeGradients) {
  const Irregularities fresh(77);
  const Capture capture{.size_cm = 19, .camera_cm = 31};
  for (const std::string& name : material_names()) {
    const auto material = make_material(name);
    const std::vector<int> discrete(material->table().discrete.size(), 0);
    at::Tensor parameters = tensor_of(prior_location(material->table()).continuous, at::kFloat);
    const auto image = [&] {
      return display(shade(material->surface(parameters, discrete, fresh, capture, 40), capture, 40),
                     DisplayCurve::srgb);
    };
    at::Tensor before;
    {
      const c10::InferenceMode inference;
      before = image();
    }
    parameters.set_requires_grad(true);
    const at::Tensor after = image();
    EXPECT_TRUE(before.equal(after.detach()));
    ASSERT_NO_THROW(after.sum().backward());
  }
}

TEST(Irregularities, ServeSeveralThreadsAtOnce) {
  const Irregularities alone(5), shared(5);
  const auto leather = make_material("leather");
  const auto height = [&](const Irregularities& z, int level) {
    const at::Tensor at = tensor_of(prior_location(leather->table()).continuous, at::kFloat);
    return leather->surface(at, std::vector{0, level}, z, Capture{}, 32).height;
  };
  std::array<at::Tensor, 4> heights;
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 4; ++i)
      threads.emplace_back([&, i] { heights[static_cast<std::size_t>(i)] = height(shared, i % 2); });
  }
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(heights[static_cast<std::size_t>(i)].equal(height(alone, i % 2)));
}

}  // namespace
}  // namespace patina
