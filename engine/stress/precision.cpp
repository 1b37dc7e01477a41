#include <atomic>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/sampling/rng.h"
#include "engine/stress/density.h"
#include "engine/stress/scenarios.h"

namespace patina {
namespace {

constexpr Eigen::Index kDimension = 8;
constexpr double kSd = 0.3;

Evaluation normal(const Position& p) {
  return {-0.5 * p.continuous.squaredNorm() / (kSd * kSd), -p.continuous / (kSd * kSd)};
}

KnownPosterior known_normal(FunctionDensity::Function function) {
  KnownPosterior posterior = in_coordinates(kDimension, std::move(function));
  for (std::size_t i = 0; i < kDimension; ++i) posterior.known.push_back(parameter(posterior, i, 0, kSd));
  return posterior;
}

/// N(0, sd^2 I) whose value is drawn anew in every evaluation.
KnownPosterior noisy(double noise) {
  const auto calls = std::make_shared<std::atomic<std::uint64_t>>(0);
  return known_normal([=](const Position& p) {
    Rng rng(20, ++*calls);
    Evaluation e = normal(p);
    e.log_density += noise * rng.normal();
    return e;
  });
}

/// The nearest number of so many bits (8: bfloat16, 24: float32).
double rounded(double value, int bits) {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  return std::ldexp(std::round(std::ldexp(mantissa, bits)), exponent - bits);
}

/// N(0, sd^2 I) on top of a large constant, kept in few bits.
KnownPosterior coarse(double constant, int bits) {
  return known_normal([=](const Position& p) {
    Evaluation e = normal(p);
    e.log_density = rounded(e.log_density - constant, bits) + constant;
    return e;
  });
}

}  // namespace

std::vector<Scenario> precision_scenarios() {
  constexpr int kFloat = 24, kBfloat = 8;
  return {
      density_scenario("noise 0.05", "a value that scatters by 0.05 nats", "closed form",
                       [] { return noisy(0.05); }),
      density_scenario("noise 1", "a value that scatters by one nat (fresh z in each evaluation)",
                       "closed form", [] { return noisy(1); }),
      density_scenario("noise 3", "a value that scatters by three nats", "closed form",
                       [] { return noisy(3); }),
      density_scenario("float32 at 1e6", "energies kept in float32 on top of 1e6", "closed form",
                       [] { return coarse(1e6, kFloat); }),
      density_scenario("float32 at 1e8", "energies kept in float32 on top of 1e8", "closed form",
                       [] { return coarse(1e8, kFloat); }),
      density_scenario("bfloat16 at 1e2", "energies kept in bfloat16 on top of 100", "closed form",
                       [] { return coarse(1e2, kBfloat); }),
      density_scenario("bfloat16 at 1e3", "the same on top of 1000", "closed form",
                       [] { return coarse(1e3, kBfloat); }),
      density_scenario("bfloat16 at 1e4", "the same on top of 10000", "closed form",
                       [] { return coarse(1e4, kBfloat); }),
  };
}

}  // namespace patina
