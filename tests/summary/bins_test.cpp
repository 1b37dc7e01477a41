// Means and spectra of regions: "rings", "bands" and "means" against plain loops and images whose answer is
// known.
#include <ATen/TensorOperators.h>
#include <ATen/ops/full.h>
#include <ATen/ops/zeros.h>

#include <cmath>
#include <numbers>

#include "engine/summary/bin_means.h"
#include "engine/summary/log_spectrum.h"
#include "engine/summary/summary_name.h"
#include "tests/summary/gradients.h"
#include "tests/summary/naive.h"
#include "tests/summary/network_files.h"

namespace patina {
namespace {

/// A grey image [3, n, n] from a brightness of the pixel centre's place, x to the right, y down, in [0, 1].
template <typename Brightness>
at::Tensor grey(int n, Brightness&& brightness) {
  at::Tensor image = at::zeros({3, n, n}, at::kFloat);
  auto pixel = image.accessor<float, 3>();
  for (int c = 0; c < 3; ++c)
    for (int row = 0; row < n; ++row)
      for (int column = 0; column < n; ++column)
        pixel[c][row][column] = static_cast<float>(brightness((column + 0.5) / n, (row + 0.5) / n));
  return image;
}

at::Tensor cosine(int n, int fx, int fy, double amplitude) {
  return grey(n, [&](double x, double y) {
    return 0.5 + amplitude * std::cos(2 * std::numbers::pi * (fx * x + fy * y) + 0.7);
  });
}

double value(const at::Tensor& vector, std::int64_t i) { return vector[i].item<double>(); }

double largest_difference(const at::Tensor& a, const at::Tensor& b) {
  return (a - b).abs().max().item<double>();
}

TEST(RingMeans, EqualMeansOverThePixelsOfEachRing) {
  constexpr int kSide = 23, kRings = 4;
  const naive::Maps image = naive::from_tensor(random_image(kSide));
  double sums[3][kRings] = {}, counts[kRings] = {};
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) {
      const double x = column - (kSide - 1) / 2.0, y = row - (kSide - 1) / 2.0;  // pixels from the centre
      const double radius = std::sqrt(x * x + y * y);
      const int ring = radius < kSide / 8.0 ? 0 : radius < kSide / 4.0 ? 1 : radius < 3 * kSide / 8.0 ? 2 : 3;
      ++counts[ring];
      for (int c = 0; c < 3; ++c) sums[c][ring] += image.at(c, row, column);
    }
  const at::Tensor means = RingMeans(kRings)(random_image(kSide));
  for (int c = 0; c < 3; ++c)
    for (int ring = 0; ring < kRings; ++ring)
      EXPECT_NEAR(value(means, c * kRings + ring), sums[c][ring] / counts[ring], 1e-5);
}

TEST(RingMeans, ADiscFillsTheRingsWithinItAndNoOther) {
  const RingMeans rings(16);
  const at::Tensor disc =
      grey(128, [](double x, double y) { return std::hypot(x - 0.5, y - 0.5) < 5 / 32.0 ? 0.75 : 0.25; });
  const at::Tensor means = rings(disc);
  for (int i = 0; i < 3 * 16; ++i) EXPECT_NEAR(value(means, i), i % 16 < 5 ? 0.75 : 0.25, 1e-4) << i;
  EXPECT_NEAR(value(RingMeans(16)(grey(32, [](double, double) { return 0.4; })), 0), 0.4, 1e-4)
      << "at the smallest resolution no ring is empty";
}

TEST(StripMeans, EqualMeansOfColumnsAlsoWherePixelsAreShared) {
  const at::Tensor image = random_image(12);
  const at::Tensor columns = image.mean(1);  // [3, 12]
  const at::Tensor strips = StripMeans(4)(image);
  for (int c = 0; c < 3; ++c)
    for (int strip = 0; strip < 4; ++strip)
      EXPECT_NEAR(value(strips, c * 4 + strip),
                  columns[c].slice(0, 3 * strip, 3 * strip + 3).mean().item<double>(), 1e-5);
  const at::Tensor shared = StripMeans(8)(image);  // a strip is a pixel and a half wide
  EXPECT_NEAR(value(shared, 0), (columns[0][0] + columns[0][1] * 0.5).item<double>() / 1.5, 1e-5);
  EXPECT_NEAR(value(shared, 1), (columns[0][1] * 0.5 + columns[0][2]).item<double>() / 1.5, 1e-5);
}

TEST(StripMeans, AnUprightBarIsOneStrip) {
  const at::Tensor bar = grey(64, [](double x, double) { return x >= 0.25 && x < 0.3125 ? 1.0 : 0.0; });
  const at::Tensor strips = StripMeans(16)(bar), across = StripMeans(16)(bar.transpose(1, 2));
  for (int i = 0; i < 3 * 16; ++i) {
    EXPECT_NEAR(value(strips, i), i % 16 == 4 ? 1 : 0, 1e-6) << i;
    EXPECT_NEAR(value(across, i), 1 / 16.0, 1e-6) << i;
  }
}

TEST(BandEdges, RiseFromOneToTheNyquistFrequencyInRatiosThatNeverShrinkByMoreThanRounding) {
  for (const int bands : {8, 16})
    for (int nyquist = bands; nyquist <= 2048; ++nyquist) {
      const std::vector<int> edges = band_edges(nyquist, bands);
      ASSERT_EQ(edges.size(), static_cast<std::size_t>(bands) + 1);
      ASSERT_EQ(edges.front(), 1);
      ASSERT_EQ(edges.back(), nyquist + 1);
      for (int band = 0; band < bands; ++band)
        ASSERT_LT(edges[static_cast<std::size_t>(band)], edges[static_cast<std::size_t>(band) + 1])
            << nyquist;
    }
  EXPECT_EQ(band_edges(256, 8), (std::vector<int>{1, 2, 4, 8, 16, 32, 64, 128, 257})) << "octaves";
}

TEST(RingSpectrum, APureCosineLandsInOneRingWithItsPowerSharedByTheRingsWaves) {
  constexpr int kSide = 64, kRings = 8;
  const std::vector<int> edges = band_edges(kSide / 2, kRings);
  for (const auto& [fx, fy] : {std::pair(3, 4), std::pair(-7, 5), std::pair(1, 0), std::pair(20, -20)}) {
    const double radius = std::hypot(fx, fy);
    int waves[kRings] = {}, expected_ring = 0;  // of the whole plane
    const auto ring_of = [&](double r) {
      int ring = 0;
      while (ring + 1 < kRings && r >= edges[static_cast<std::size_t>(ring) + 1]) ++ring;
      return ring;
    };
    for (int y = -kSide / 2; y < kSide / 2; ++y)
      for (int x = -kSide / 2; x < kSide / 2; ++x)
        if (x != 0 || y != 0) ++waves[ring_of(std::hypot(x, y))];
    expected_ring = ring_of(radius);
    constexpr double kAmplitude = 0.3;
    const at::Tensor spectrum = RingSpectrum(kRings)(cosine(kSide, fx, fy, kAmplitude));
    // Parseval: the variance A^2 / 2 of n^2 pixels lies on the ring's waves.
    const double power = kAmplitude * kAmplitude / 2 * kSide * kSide / waves[expected_ring];
    for (int ring = 0; ring < kRings; ++ring)
      EXPECT_NEAR(value(spectrum, ring), std::log((ring == expected_ring ? power : 0) + kRoundingPower), 1e-3)
          << fx << ", " << fy << " in ring " << ring;
  }
}

TEST(RingSpectrum, WhiteNoiseHasItsVarianceInEveryRing) {
  const at::Tensor noise = (random_tensor({128, 128}, 6, 0.1) + 0.5).expand({3, 128, 128});
  const at::Tensor spectrum = RingSpectrum(8)(noise);
  for (int ring = 4; ring < 8; ++ring)  // the coarser ones have few waves
    EXPECT_NEAR(value(spectrum, ring), std::log(0.01), 0.15) << ring;
}

TEST(ColumnSpectrum, AWaveAlongTheColumnsLandsInOneBandWhateverItsPhaseAndOneAcrossInNone) {
  constexpr int kSide = 64, kBands = 16;
  const std::vector<int> edges = band_edges(kSide / 2, kBands);
  const ColumnSpectrum summary(kBands);
  for (const int fy : {1, 5, 18, 31}) {
    int expected = 0;
    while (expected + 1 < kBands && fy >= edges[static_cast<std::size_t>(expected) + 1]) ++expected;
    const at::Tensor spectrum = summary(cosine(kSide, 0, fy, 0.2));
    EXPECT_LT(largest_difference(spectrum, summary(cosine(kSide, 3, fy, 0.2))), 1e-3)
        << "oblique: the phase changes from column to column";
    for (int band = 0; band < kBands; ++band) {
      if (band == expected)
        EXPECT_GT(value(spectrum, band), std::log(0.01)) << fy;
      else
        EXPECT_NEAR(value(spectrum, band), std::log(kRoundingPower), 1e-3) << fy << " in band " << band;
    }
  }
  const at::Tensor across = summary(cosine(kSide, 5, 0, 0.2));
  EXPECT_NEAR(across.max().item<double>(), std::log(kRoundingPower), 1e-3);
}

TEST(Rings, AreBlindToARotationThatBandsSee) {
  const auto rings = make_summary("rings", {}), bands = make_summary("bands", {});
  const at::Tensor image = random_image(64) * grey(64, [](double x, double) { return 0.4 + 0.6 * x; });
  const at::Tensor turned = image.transpose(1, 2).flip(1);
  EXPECT_LT(largest_difference((*rings)(image), (*rings)(turned)), 1e-4);
  EXPECT_GT(largest_difference((*bands)(image), (*bands)(turned)), 0.1);
  // By 30 degrees, of waves that no pixel grid disturbs: the coarse structure moves within its ring.
  const auto waves = [](double angle) {
    return grey(64, [angle](double x, double y) {
      const double u = std::cos(angle) * (x - 0.5) + std::sin(angle) * (y - 0.5);
      return 0.5 + 0.3 * std::cos(2 * std::numbers::pi * 11 * u) *
                       std::exp(-40 * (std::pow(x - 0.5, 2) + std::pow(y - 0.5, 2)));
    });
  };
  const at::Tensor spectrum = RingSpectrum(8)(waves(0)),
                   at_30_degrees = RingSpectrum(8)(waves(std::numbers::pi / 6));
  // Where there is next to no power the logarithm shows the grid, so the powers themselves are compared.
  EXPECT_LT(largest_difference(spectrum.exp(), at_30_degrees.exp()),
            0.1 * spectrum.exp().sum().item<double>());
  EXPECT_GT(spectrum.max().item<double>() - spectrum.min().item<double>(), 3) << "a spectrum with a peak";
}

TEST(Bins, GradientsEqualCentralDifferences) {
  for (const char* name : {"rings", "bands", "means", "rings+bands"})
    EXPECT_LT(gradient_error(*make_summary(name, {}), 32, 3e-3), 2e-3) << name;
}

TEST(Bins, AreFiniteWithTheirGradientsOnAConstantImageAndAtTheSmallestResolution) {
  for (const char* name : {"rings", "bands", "means"}) {
    const auto summary = make_summary(name, {});
    for (const int n : {summary->minimum_resolution(), 65}) {
      const at::Tensor leaf = at::full({3, n, n}, 0.5, at::kFloat).set_requires_grad(true);
      const at::Tensor vector = (*summary)(leaf);
      vector.square().sum().backward();
      EXPECT_TRUE(std::isfinite(vector.sum().item<double>())) << name << ' ' << n;
      EXPECT_TRUE(std::isfinite(leaf.grad().sum().item<double>())) << name << ' ' << n;
    }
  }
}

TEST(Composition, OfFewerLevelsBeginsWithTheSameAndKeepsAllThatHasNoNetwork) {
  const at::Tensor image = random_image(64);
  EXPECT_EQ(with_levels("gram+rings", 3), "gram3+rings");
  EXPECT_EQ(with_levels("rings+gram5", 2), "rings+gram2");
  EXPECT_EQ(with_levels("covariances+gram", 2), "covariances2+gram2");
  EXPECT_EQ(with_levels("bands", 2), "bands");
  const auto all = make_summary("gram+rings", {}), some = make_summary("gram2+rings", {});
  EXPECT_EQ(levels_of(*all), 5);
  EXPECT_EQ(levels_of(*some), 2);
  const at::Tensor whole = (*all)(image), part = (*some)(image);
  const std::int64_t grams = some->blocks()[0].size + some->blocks()[1].size, rest = part.numel() - grams;
  EXPECT_TRUE(part.slice(0, 0, grams).equal(whole.slice(0, 0, grams)));
  EXPECT_TRUE(part.slice(0, grams).equal(whole.slice(0, whole.numel() - rest)));
}

TEST(SummaryName, LosesItsCovariancesWhereGramMatricesStay) {
  EXPECT_EQ(without_covariances("covariances+bands+gram2"), "bands+gram2");
  EXPECT_EQ(without_covariances("gram3+covariances3"), "gram3");
  EXPECT_EQ(without_covariances("covariances+rings"), "covariances+rings") << "something has to stay";
}

TEST(Composition, OfGramMatricesAndCovariancesRunsTheNetworkOnceToTheSameNumbersAndGradients) {
  const at::Tensor image = random_image(64);
  const auto with_gradient = [&](const std::string& name) {
    const at::Tensor leaf = image.clone().requires_grad_(true);
    const at::Tensor vector = (*make_summary(name, {}))(leaf);
    vector.sum().backward();
    return std::pair{vector.detach(), leaf.grad()};
  };
  const auto [gram, by_gram] = with_gradient("gram2");
  const auto [covariances, by_covariances] = with_gradient("covariances2");
  const auto [means, by_means] = with_gradient("means");
  const auto [both, by_both] = with_gradient("gram2+means+covariances");
  const std::int64_t grams = gram.numel() - means.numel();
  ASSERT_EQ(both.numel(), 2 * grams + means.numel());
  EXPECT_TRUE(both.slice(0, 0, grams).equal(gram.slice(0, 0, grams)));
  EXPECT_TRUE(both.slice(0, grams, 2 * grams).equal(covariances.slice(0, 0, grams)));
  EXPECT_TRUE(both.slice(0, 2 * grams).equal(means));
  EXPECT_TRUE(by_both.allclose(by_gram + by_covariances - by_means, 1e-4, 1e-5));
  EXPECT_EQ(levels_of(*make_summary("gram2+covariances2", {})), 2);
}

TEST(Composition, IsItsPartsInOrderAndWhatTheyShareOnce) {
  const at::Tensor image = random_image(64);
  const auto parts = make_summary("bands+means", {});
  const at::Tensor bands = (*make_summary("bands", {}))(image), means = (*make_summary("means", {}))(image);
  const at::Tensor both = (*parts)(image);
  ASSERT_EQ(both.numel(), bands.numel() + means.numel());
  EXPECT_TRUE(both.slice(0, 0, bands.numel()).equal(bands));
  EXPECT_TRUE(both.slice(0, bands.numel()).equal(means));
  EXPECT_EQ(parts->blocks().size(), 3u);
  EXPECT_EQ(parts->minimum_resolution(), 32);
  EXPECT_EQ(make_summary("gram+means", {})->blocks().size(), make_summary("gram", {})->blocks().size());
  for (const char* bad :
       {"", "+", "gram+", "+means", "gram++means", "gram,means", "gram + means", "gram0", "gram10", "rings3"})
    EXPECT_NE(user_error([&] { make_summary(bad, {}); }).find("There is no summary"), std::string::npos)
        << bad;
}

}  // namespace
}  // namespace patina
