#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <ATen/ops/full.h>
#include <ATen/ops/ones.h>
#include <ATen/ops/rand.h>
#include <ATen/ops/stack.h>
#include <ATen/ops/zeros.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/material/gaussian_heightfield.h"
#include "engine/material/heightfield.h"
#include "engine/material/shading.h"
#include "materials_fixture.h"
#include "one_pass.h"

namespace patina {
namespace {

constexpr double kPi = std::numbers::pi;

at::Tensor double_scalar(double x) { return at::full({}, x, at::kDouble); }

double relative_difference(const at::Tensor& a, const at::Tensor& b) {
  return ((a - b).square().mean() / b.square().mean()).sqrt().item<double>();
}

/// At three times the resolution, every third pixel, counted from the second, has the same centre.
at::Tensor at_coarse_centres(const at::Tensor& fine) {
  return fine.slice(-2, 1, c10::nullopt, 3).slice(-1, 1, c10::nullopt, 3);
}

// ---- heightfields ----

TEST(GaussianHeightfield, IsTheSumOverFrequenciesThatItsDocumentationWrites) {
  constexpr int n = 6;
  const double size = 3, fscale = 0.2, sigma_x = 0.7, sigma_y = 0.4;
  const at::Tensor height = gaussian_heightfield(shared_irregularities(), double_scalar(fscale),
                                                 double_scalar(sigma_x), double_scalar(sigma_y), size, n);
  const Phasors phasors = shared_irregularities().phasors(n, at::kDouble);
  const auto phasor = [&](int f, int g,
                          int part) {  // the half of the plane that `forward` lacks is conjugate
    const bool have = g >= 0 || g == -n / 2;
    const at::Tensor& half = have ? phasors.forward : phasors.mirrored;
    const int row = ((have ? f : -f) + n) % n, column = std::abs(g);
    return half[row][column][part].item<double>() * (part == 1 && !have ? -1 : 1);
  };
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      double sum = 0;
      for (int f = -n / 2; f < n / 2; ++f)
        for (int g = -n / 2; g < n / 2; ++g) {
          const double fx = (g + 0.5) / size, fy = (f + 0.5) / size;
          const double amplitude =
              fscale * std::exp(-std::pow(fx / sigma_x, 2) / 2 - std::pow(fy / sigma_y, 2) / 2);
          const double angle = 2 * kPi * (f * row + g * column) / n;
          sum += amplitude * (phasor(f, g, 0) * std::cos(angle) - phasor(f, g, 1) * std::sin(angle));
        }
      EXPECT_NEAR(height[row][column].item<double>(), sum / (size * size), 1e-12);
    }
}

TEST(GaussianHeightfield, InOnePassOverFrequenciesEqualsTensorOperationsWithItsGradient) {
  for (const int n : {32, 45}) {
    const auto height = [n](const std::vector<at::Tensor>& i) {
      return gaussian_heightfield(shared_irregularities(), i[0], i[1], i[2], 3, n);
    };
    expect_same(height, height, {double_scalar(0.2), double_scalar(1.7), double_scalar(2.4)});
  }
}

TEST(GaussianHeightfield, HasTheVarianceOfItsSpectrum) {
  const int n = 256;
  const double size = 21.21, fscale = 0.1, sigma = 2;
  const at::Tensor height = gaussian_heightfield(shared_irregularities(), double_scalar(fscale),
                                                 double_scalar(sigma), double_scalar(sigma), size, n);
  // Var h = 1/2 sum A^2 / size^4, and the sum is an integral: A^2 has sd sigma / sqrt 2 on either axis.
  const double expected = fscale * fscale * kPi * sigma * sigma / (2 * size * size);
  EXPECT_NEAR(height.var().item<double>() / expected, 1, 0.1);
}

TEST(GaussianHeightfield, AFinerGridSamplesTheSameSurface) {
  const auto height = [](int n) {
    return gaussian_heightfield(shared_irregularities(), double_scalar(0.1), double_scalar(0.3),
                                double_scalar(0.4), 21.21, n);
  };
  EXPECT_LT(relative_difference(at_coarse_centres(height(216)), height(72)), 1e-3);
  EXPECT_LT(relative_difference(at_coarse_centres(height(213)), height(71)), 1e-3);  // odd sizes too
}

TEST(HeightfieldNormals, OfASineAreItsDerivativeHalfAPixelOnward) {
  constexpr int n = 400;
  const double size = 10, pixel = size / n, k = 2 * kPi * 3 / size;
  const at::Tensor x = (at::arange(n, at::kDouble) + 0.5) * pixel;
  const at::Tensor y = -x.view({n, 1});  // rows go down
  const at::Tensor normal = heightfield_normals(((x * k).sin() + (y * k * 2).cos()) * 0.1, pixel);
  const at::Tensor slope_x = -(normal[0] / normal[2]), slope_y = -(normal[1] / normal[2]);
  EXPECT_LT((slope_x - ((x + pixel / 2) * k).cos() * (0.1 * k)).abs().max().item<double>(), 1e-3);
  EXPECT_LT((slope_y + ((y + pixel / 2) * k * 2).sin() * (0.2 * k)).abs().max().item<double>(), 4e-3);
  EXPECT_LT((normal.square().sum(0) - 1).abs().max().item<double>(), 1e-12);
}

// ---- resolution ----

TEST(Leather, AFinerGridSamplesTheSameSurface) {
  const auto leather = make_material("leather");
  const at::Tensor at = tensor_of(prior_location(leather->table()).continuous, at::kDouble);
  const auto height = [&](int n) {
    return leather->surface(at, std::vector{0, 0}, shared_irregularities(), Capture{}, n).height;
  };
  // At the prior's scale of 0.5 these pixels are no wider than texels; wider ones see averages (LookUp).
  EXPECT_LT(relative_difference(at_coarse_centres(height(1536)), height(512)), 1e-12);
}

TEST(Leather, NormalsAtTheBorderAreThoseOfTheSurfaceBeyondIt) {
  constexpr int n = 64;
  const auto leather = make_material("leather");
  std::vector<double> values = prior_location(leather->table()).continuous;
  const auto normal = [&](double pixels_x, double pixels_y) {
    values[10] = pixels_x * 2 / n;
    values[11] = pixels_y * 2 / n;
    const at::Tensor at = tensor_of(values, at::kDouble);
    return leather->surface(at, std::vector{0, 0}, shared_irregularities(), Capture{}, n).normal;
  };
  const at::Tensor here = normal(0, 0), right = normal(5, 0), up = normal(0, -5);
  EXPECT_LT((here.narrow(2, 5, n - 5) - right.narrow(2, 0, n - 5)).abs().max().item<double>(), 1e-9);
  EXPECT_LT((here.narrow(1, 0, n - 5) - up.narrow(1, 5, n - 5)).abs().max().item<double>(), 1e-9);
}

class EveryMaterialAtTwoSizes : public testing::TestWithParam<std::string> {};

TEST_P(EveryMaterialAtTwoSizes, LooksAlikeInEveryBandOfFrequencies) {
  const auto material = make_material(GetParam());
  ParameterValues values = prior_location(material->table());
  const auto set = [&](const char* name, double value) {
    if (const auto i = material->table().find_continuous(name)) values.continuous[*i] = value;
  };
  set("scale", 0.15);  // features of several pixels at both sizes
  set("fsigma", 0.5);
  set("noise_scale", 0.001);
  set("ring_size", 0.8);
  set("ssn_scale", 2);
  const at::Tensor at = tensor_of(values.continuous, at::kFloat);
  const at::Tensor fine = render(*material, at, values.discrete, 512).mean(0);
  const at::Tensor coarse = render(*material, at, values.discrete, 128).mean(0);
  const auto box = [](const at::Tensor& image, std::int64_t side) {
    const std::int64_t n = image.size(0) / side;
    return image.view({n, side, n, side}).mean({1, 3});
  };
  // A band is the detail that the next halving takes away.
  at::Tensor a = box(fine, 8), b = box(coarse, 2);  // the finest band is where the coarse grid still aliases
  for (int level = 1; level < 5; ++level) {
    const at::Tensor smaller_a = box(a, 2), smaller_b = box(b, 2);
    const auto energy = [](const at::Tensor& image, const at::Tensor& smaller) {
      return (image.var() - smaller.var()).item<double>();
    };
    EXPECT_NEAR(energy(a, smaller_a) / energy(b, smaller_b), 1, 0.25) << "level " << level;
    a = smaller_a, b = smaller_b;
  }
  EXPECT_LT((a - b).abs().max().item<double>(), 0.01);
}

INSTANTIATE_TEST_SUITE_P(Materials, EveryMaterialAtTwoSizes, testing::ValuesIn(material_names()),
                         [](const auto& info) { return info.param; });

// ---- shading ----

/// models.md "Capture" for one pixel in plain doubles.
double radiance(const Capture& capture, int n, int row, int column, const std::array<double, 3>& normal,
                double albedo, double f0, double rough, double light, double sigma) {
  const double x = ((column + 0.5) / n - 0.5) * capture.size_cm,
               y = -((row + 0.5) / n - 0.5) * capture.size_cm;
  const double d = std::sqrt(x * x + y * y + capture.camera_cm * capture.camera_cm);
  const double c =
      std::clamp((-x * normal[0] - y * normal[1] + capture.camera_cm * normal[2]) / d, 1e-3, 1.0);
  const double alpha = rough * rough;
  const double ggx = 1 / (kPi * alpha * alpha * std::pow((1 - c * c) / (alpha * alpha) + c * c, 2));
  const double vignette = std::exp(-(x * x + y * y) / (2 * sigma * sigma));
  return light * vignette * c / (d * d) * (albedo / kPi + f0 * ggx / (4 * c * c));
}

at::Tensor uniform_normal(const std::array<double, 3>& normal, int n) {
  return at::stack({double_scalar(normal[0]), double_scalar(normal[1]), double_scalar(normal[2])})
      .view({3, 1, 1})
      .expand({3, n, n});
}

Surface plane(const std::array<double, 3>& direction, double rough_x, double rough_y, int n) {
  Surface surface;
  surface.base_color =
      at::stack({double_scalar(0.5), double_scalar(0.3), double_scalar(0.1)}).view({3, 1, 1});
  surface.height = at::zeros({n, n}, at::kDouble);
  surface.normal = uniform_normal(direction, n);
  const at::Tensor x = double_scalar(rough_x);
  surface.lobes = {
      {surface.normal, double_scalar(0.04).view({1}), x, rough_x == rough_y ? x : double_scalar(rough_y)}};
  surface.light = double_scalar(1300);
  surface.vignette_sigma = double_scalar(9);
  return surface;
}

TEST(Shade, AgreesWithThePapersFormulasPixelByPixel) {
  constexpr int n = 8;
  const Capture capture{.size_cm = 17, .camera_cm = 22};
  const double length = std::sqrt(0.2 * 0.2 + 0.1 * 0.1 + 1);
  for (const std::array<double, 3>& normal :
       {std::array{0.0, 0.0, 1.0},
        {0.2 / length, -0.1 / length, 1 / length},
        {1.0, 0.0, 0.0}}) {  // the last one faces away from half of the pixels
    const at::Tensor image = shade(plane(normal, 0.3, 0.3, n), capture, n);
    for (int row = 0; row < n; ++row)
      for (int column = 0; column < n; ++column)
        for (const auto& [channel, albedo] : {std::pair{0, 0.5}, {1, 0.3}, {2, 0.1}}) {
          const double expected = radiance(capture, n, row, column, normal, albedo, 0.04, 0.3, 1300, 9);
          EXPECT_NEAR(image[channel][row][column].item<double>(), expected, 1e-9 * expected);
        }
  }
}

TEST(Shade, AnisotropicLobeWithEqualRoughnessesIsTheIsotropicOne) {
  constexpr int n = 16;
  const std::array<double, 3> normal{0.36, 0.48, 0.8};
  Surface surface = plane(normal, 0.3, 0.3, n);
  const at::Tensor isotropic = shade(surface, Capture{}, n);
  surface.lobes[0].roughness_y = double_scalar(0.3);  // another tensor: the general formula
  EXPECT_LT(relative_difference(shade(surface, Capture{}, n), isotropic), 1e-12);
}

TEST(Shade, SwappingTheRoughnessesTurnsTheHighlightOfAFlatSurface) {
  constexpr int n = 16;
  const std::array<double, 3> up{0, 0, 1};
  const at::Tensor along_x = shade(plane(up, 0.2, 0.5, n), Capture{}, n);
  const at::Tensor along_y = shade(plane(up, 0.5, 0.2, n), Capture{}, n);
  EXPECT_LT(relative_difference(along_x.transpose(1, 2), along_y), 1e-12);
  EXPECT_GT(relative_difference(along_x, along_y), 0.01);
  // The wider roughness spreads its axis' highlight: y here, so the top is brighter than the side.
  EXPECT_GT(along_x[0][0][n / 2].item<double>(), along_x[0][n / 2][0].item<double>());
}

TEST(Shade, LobesAndBaseAddUp) {
  constexpr int n = 8;
  Surface both = plane({0, 0, 1}, 0.3, 0.3, n);
  both.lobes.push_back({uniform_normal({0.6, 0, 0.8}, n), at::rand({3, n, n}, at::kDouble),
                        double_scalar(0.4), double_scalar(0.6)});
  Surface base = both, first = both, second = both;
  base.lobes.clear();
  first.base_color = second.base_color = at::zeros({3, 1, 1}, at::kDouble);
  first.lobes.pop_back();
  second.lobes.erase(second.lobes.begin());
  const auto lit = [](const Surface& surface) { return shade(surface, Capture{}, n); };
  EXPECT_LT(relative_difference(lit(base) + lit(first) + lit(second), lit(both)), 1e-12);
}

TEST(Display, CurvesAreTheTextbookOnes) {
  const at::Tensor linear = at::arange(1, 1001, at::kDouble) / 1000;
  const at::Tensor power = display(linear, DisplayCurve::gamma22), srgb = display(linear, DisplayCurve::srgb);
  EXPECT_LT((power.pow(2.2) - linear).abs().max().item<double>(), 1e-12);
  for (std::int64_t i = 0; i < linear.numel(); ++i) {
    const double shown = srgb[i].item<double>();
    const double back = shown <= 0.04045 ? shown / 12.92 : std::pow((shown + 0.055) / 1.055, 2.4);
    EXPECT_NEAR(back, linear[i].item<double>(), 1e-6);
  }
}

TEST(Display, ClampsAndKeepsItsGradientFinite) {
  for (const DisplayCurve curve : {DisplayCurve::srgb, DisplayCurve::gamma22}) {
    const at::Tensor radiance = at::stack(
        {double_scalar(-1), double_scalar(0), double_scalar(1e-9), double_scalar(1), double_scalar(7)});
    const at::Tensor leaf = radiance.to(at::kFloat).set_requires_grad(true);
    const at::Tensor shown = display(leaf, curve);
    EXPECT_LT(shown[0].item<float>(), 0.5 / 255);
    EXPECT_FLOAT_EQ(shown[3].item<float>(), 1);
    EXPECT_FLOAT_EQ(shown[4].item<float>(), 1);
    shown.sum().backward();
    EXPECT_TRUE(leaf.grad().isfinite().all().item<bool>());
  }
}

}  // namespace
}  // namespace patina
