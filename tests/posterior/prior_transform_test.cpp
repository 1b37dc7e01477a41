#include "engine/posterior/prior_transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/error.h"

namespace patina {
namespace {

// Interior, piled at a bound, one-sided, far outside, and every oddly shaped prior of the materials.
const TruncatedNormal kPriors[] = {{0.4, 0.3, 0, 1}, {1500, 400, 0, 2500}, {0.01, 0.1, 0.001, 0.025},
                                   {0, 0.3, -1, 1},  {0.01, 2, 0, 1},      {10, 3, 1, 500},
                                   {1.3, 0.1, 0, 1}, {-0.5, 0.2, 0, 1},    {15, 3, 5, 20}};

double prior_density(const TruncatedNormal& prior, double t) {
  const auto cdf = [&](double x) {
    return 0.5 * std::erfc(-(x - prior.mean) / prior.sd / std::numbers::sqrt2);
  };
  const double z = (t - prior.mean) / prior.sd;
  return std::exp(-0.5 * z * z) / (prior.sd * std::sqrt(2 * std::numbers::pi)) /
         (cdf(prior.high) - cdf(prior.low));
}

double standard_normal_density(double u) { return std::exp(-0.5 * u * u) / std::sqrt(2 * std::numbers::pi); }

TEST(PriorTransform, ValueThenCoordinateThenValueIsTheIdentity) {
  for (const TruncatedNormal& prior : kPriors) {
    const PriorTransform transform(prior);
    for (double u = -7.9; u < 8; u += 0.1) {
      const double t = transform.value(u);
      EXPECT_NEAR(transform.value(transform.coordinate(t)), t, 1e-12 * (prior.high - prior.low))
          << prior.mean << " " << u;
    }
  }
}

TEST(PriorTransform, ValuesStayWithinTheBoundsAndGrow) {
  for (const TruncatedNormal& prior : kPriors) {
    const PriorTransform transform(prior);
    double previous = prior.low;
    for (double u = -12; u < 12; u += 0.05) {
      const double t = transform.value(u);
      EXPECT_GE(t, previous);
      EXPECT_LE(t, prior.high);
      previous = t;
    }
  }
}

TEST(PriorTransform, DerivativeIsThatOfTheValue) {
  for (const TruncatedNormal& prior : kPriors) {
    const PriorTransform transform(prior);
    for (double u = -4; u <= 4; u += 0.25) {
      const double h = 1e-5;
      const double difference = (transform.value(u + h) - transform.value(u - h)) / (2 * h);
      EXPECT_NEAR(transform.derivative(u), difference,
                  1e-6 * std::abs(difference) + 1e-9 * (prior.high - prior.low));
    }
  }
}

TEST(PriorTransform, TurnsThePriorIntoAStandardNormal) {
  // p(u) = p(t) dt/du must be phi(u): two routes to one density.
  for (const TruncatedNormal& prior : kPriors) {
    const PriorTransform transform(prior);
    for (double u = -4; u <= 4; u += 0.5) {
      const double pushed = prior_density(prior, transform.value(u)) * transform.derivative(u);
      EXPECT_NEAR(pushed / standard_normal_density(u), 1, 1e-6) << prior.mean << " at " << u;
    }
  }
}

TEST(PriorTransform, TruncatedSdMatchesQuadrature) {
  for (const TruncatedNormal& prior : kPriors) {
    const PriorTransform transform(prior);
    double mass = 0, mean = 0, square = 0;
    for (double u = -7.995; u < 8; u += 0.01) {
      const double t = transform.value(u), weight = standard_normal_density(u);
      mass += weight, mean += weight * t, square += weight * t * t;
    }
    mean /= mass;
    EXPECT_NEAR(truncated_sd(prior) / std::sqrt(square / mass - mean * mean), 1, 1e-3) << prior.mean;
  }
}

TEST(PriorTransform, RefusesImpossiblePriorsInOneSentence) {
  for (const TruncatedNormal& prior : {TruncatedNormal{0, 0, 0, 1},
                                       {0, -1, 0, 1},
                                       {0, 1, 1, 1},
                                       {0, 1, 2, 1},
                                       {NAN, 1, 0, 1},
                                       {0, 1, 0, INFINITY},
                                       {100, 1, 0, 1}})
    EXPECT_THROW(PriorTransform{prior}, UserError);
}

}  // namespace
}  // namespace patina
