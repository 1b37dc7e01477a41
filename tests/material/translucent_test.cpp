#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <ATen/ops/zeros_like.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "engine/material/subsurface.h"
#include "materials_fixture.h"

namespace patina {
namespace {

struct Coefficients {
  double scattering, absorption, anisotropy;
};

Medium medium(const Coefficients& c) {
  const auto scalar = [](double x) { return at::tensor(x, at::kDouble); };
  return {scalar(c.scattering), scalar(c.absorption), scalar(c.anisotropy)};
}

constexpr std::array<double, 5> kRings{0.3, 0.6, 1.2, 2.4, 4.8};  // cm
using RingPowers = std::array<double, kRings.size() - 1>;

/// Power that leaves within each ring, of a radial profile.
RingPowers ring_powers(at::Tensor (*profile)(const Medium&, const at::Tensor&), const Coefficients& c) {
  RingPowers powers{};
  constexpr int kSteps = 200;
  for (std::size_t i = 0; i < powers.size(); ++i) {
    const double width = (kRings[i + 1] - kRings[i]) / kSteps;
    const at::Tensor radius = kRings[i] + (at::arange(kSteps, at::kDouble) + 0.5) * width;
    powers[i] = (profile(medium(c), radius) * radius).sum().item<double>() * 2 * std::numbers::pi * width;
  }
  return powers;
}

/// The same by following photons one by one through a half space of refractive index 1.5 (Wang, Jacques,
/// Zheng 1995).
class PhotonTracer {
 public:
  explicit PhotonTracer(Coefficients medium) : medium_(medium) {}

  void trace(int photons) {
    for (int i = 0; i < photons; ++i) follow(0.96 / photons);
  }
  const RingPowers& once() const { return once_; }  ///< scattered once and never reflected
  const RingPowers& more() const { return more_; }
  double total() const { return total_; }

 private:
  double uniform() { return std::uniform_real_distribution<double>(1e-12, 1)(random_); }

  void follow(double weight) {
    std::array<double, 3> at{0, 0, 0}, way{0, 0, 1};
    const double extinction = medium_.scattering + medium_.absorption;
    int events = 0;
    while (true) {
      const double step = -std::log(uniform()) / extinction;
      if (at[2] + step * way[2] < 0) {
        const double to_surface = -at[2] / way[2];
        for (std::size_t k = 0; k < 3; ++k) at[k] += to_surface * way[k];
        at[2] = 0;
        if (uniform() >= reflectance(-way[2])) return leave(std::hypot(at[0], at[1]), weight, events);
        way[2] = -way[2];
        events += 2;  // not what single scattering means
        continue;
      }
      for (std::size_t k = 0; k < 3; ++k) at[k] += step * way[k];
      if (uniform() * extinction < medium_.absorption) return;
      scatter(way);
      ++events;
    }
  }

  void leave(double radius, double weight, int events) {
    total_ += weight;
    for (std::size_t i = 0; i + 1 < kRings.size(); ++i)
      if (radius >= kRings[i] && radius < kRings[i + 1]) (events == 1 ? once_ : more_)[i] += weight;
  }

  /// Henyey-Greenstein.
  void scatter(std::array<double, 3>& way) {
    const double g = medium_.anisotropy, u = uniform();
    const double fraction = (1 - g * g) / (1 - g + 2 * g * u);
    const double cosine = std::abs(g) < 1e-3 ? 2 * u - 1 : (1 + g * g - fraction * fraction) / (2 * g);
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine)), phi = 2 * std::numbers::pi * uniform();
    const auto [x, y, z] = way;
    const double across = std::sqrt(std::max(1e-12, 1 - z * z)), c = std::cos(phi), s = std::sin(phi);
    way = {sine * (x * z * c - y * s) / across + x * cosine, sine * (y * z * c + x * s) / across + y * cosine,
           -sine * c * across + z * cosine};
    if (1 - z * z < 1e-12) way = {sine * c, sine * s, z * cosine};
  }

  static double reflectance(double cosine) {
    const double outside_square = 1 - 2.25 * (1 - cosine * cosine);
    if (outside_square <= 0) return 1;
    const double outside = std::sqrt(outside_square);
    const double p = (cosine - 1.5 * outside) / (cosine + 1.5 * outside),
                 s = (1.5 * cosine - outside) / (1.5 * cosine + outside);
    return (p * p + s * s) / 2;
  }

  Coefficients medium_;
  std::mt19937_64 random_{3};
  RingPowers once_{}, more_{};
  double total_ = 0;
};

class EveryMedium : public testing::TestWithParam<Coefficients> {};

TEST_P(EveryMedium, SendsOutWhatPhotonsFollowedOneByOneDo) {
  PhotonTracer tracer(GetParam());
  tracer.trace(60000);
  const RingPowers once = ring_powers(single_scattering, GetParam()),
                   more = ring_powers(multiple_scattering, GetParam());
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_NEAR(once[i], tracer.once()[i], 0.05 * once[i] + 5e-4) << "ring " << i;
    // Diffusion is an approximation; within a mean free path of the beam it is at its worst.
    EXPECT_NEAR(more[i], tracer.more()[i], 0.3 * tracer.more()[i] + 3e-3) << "ring " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Media, EveryMedium,
                         testing::Values(Coefficients{5, 0.05, 0}, Coefficients{3, 0.2, 0.6},
                                         Coefficients{2, 0.1, -0.4}));

TEST(Translucent, MultipleScatteringKnowsScatteringAndAnisotropyByTheirProductAlone) {
  const at::Tensor radius = at::arange(1, 50, at::kDouble) / 10;
  const at::Tensor one = multiple_scattering(medium({6, 0.05, 0.5}), radius),
                   similar = multiple_scattering(medium({3.75, 0.05, 0.2}), radius),
                   other = multiple_scattering(medium({6, 0.05, 0.2}), radius);
  EXPECT_LT((one / similar - 1).abs().max().item<double>(), 1e-12);
  EXPECT_GT((one / other - 1).abs().max().item<double>(), 0.1);
}

/// Single scattering as the mean of so many angles that it is exact.
at::Tensor by_many_angles(const Coefficients& c, const at::Tensor& radius) {
  constexpr int kAngles = 20000;
  const auto leaving = [](double cosine) {
    const double square_sine = 2.25 * (1 - cosine * cosine);
    if (square_sine >= 1) return 0.0;
    const double outside = std::sqrt(1 - square_sine);
    const double p = (cosine - 1.5 * outside) / (cosine + 1.5 * outside),
                 s = (1.5 * cosine - outside) / (1.5 * cosine + outside);
    return 1 - (p * p + s * s) / 2;
  };
  at::Tensor sum = at::zeros_like(radius);
  for (int i = 0; i < kAngles; ++i) {
    const double angle = (i + 0.5) / kAngles * std::numbers::pi / 2, cosine = std::sin(angle);
    if (leaving(cosine) == 0) continue;
    const double g = c.anisotropy, base = 1 + g * g + 2 * g * cosine;
    const double phase = (1 - g * g) / (base * std::sqrt(base)) / (4 * std::numbers::pi);
    const at::Tensor path = radius * ((1 + cosine) / std::cos(angle));
    sum += (-(c.scattering + c.absorption) * path).exp() * (phase * cosine * leaving(cosine));
  }
  return sum / radius * (0.96 * c.scattering * std::numbers::pi / 2 / kAngles);
}

TEST(Translucent, SixteenNodesAreEnoughForSingleScattering) {
  const at::Tensor radius = at::arange(1, 60, at::kDouble) / 8;
  for (const Coefficients& c : {Coefficients{2, 0.02, 0.3}, {10, 0.2, -0.9}, {0.2, 0.001, 0.9}}) {
    const at::Tensor all = multiple_scattering(medium(c), radius) + single_scattering(medium(c), radius);
    const at::Tensor error = single_scattering(medium(c), radius) - by_many_angles(c, radius);
    EXPECT_LT((error / all).abs().max().item<double>(), 5e-4) << c.scattering;
  }
}

TEST(Translucent, SimilarMediaLookNearlyAlikeButNotQuite) {
  const auto material = make_material("translucent");
  const auto image = [&](double scattering, double anisotropy) {
    return render(*material, tensor_of({30, scattering, 0.02, anisotropy, 15}, at::kDouble), {}, 64);
  };
  const auto difference = [](const at::Tensor& a, const at::Tensor& b) {
    return (a - b).square().mean().sqrt().item<double>();
  };
  const at::Tensor here = image(2, 0.5);
  const double along = difference(here, image(1.25, 0.2)), across = difference(here, image(1.25, 0.5));
  EXPECT_GT(along, 1e-4);
  EXPECT_LT(along, 0.2 * across);
}

TEST(Translucent, GlowsTheSameAtEveryResolution) {
  const auto material = make_material("translucent");
  const at::Tensor at = tensor_of(prior_location(material->table()).continuous, at::kDouble);
  const at::Tensor coarse = render(*material, at, {}, 64), fine = render(*material, at, {}, 192);
  const at::Tensor centres = fine.slice(1, 1, 192, 3).slice(2, 1, 192, 3);
  EXPECT_LT((coarse - centres).abs().max().item<double>(), 1e-3);
}

}  // namespace
}  // namespace patina
