// The functions of vectors against the standard library's in double precision; run again with narrower
// vectors (tests/CMakeLists.txt).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#define PATINA_KERNEL "tests/material/simd_functions.simd.h"
#include "engine/simd/each_target.h"

namespace patina::testing {
namespace {

void exp2_of(const std::vector<float>& x, std::vector<float>& to) { PATINA_ON_TARGET(exp2_of(x, to)); }
void log2_of(const std::vector<float>& x, std::vector<float>& to) { PATINA_ON_TARGET(log2_of(x, to)); }
void pow_of(const std::vector<float>& x, float exponent, std::vector<float>& to) {
  PATINA_ON_TARGET(pow_of(x, exponent, to));
}
void clamp_of(const std::vector<float>& x, float low, float high, std::vector<float>& to) {
  PATINA_ON_TARGET(clamp_of(x, low, high, to));
}

/// No multiple of a vector's length, the ends among them.
std::vector<float> numbers_between(float low, float high) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(low, high);
  std::vector<float> numbers(20011);
  std::ranges::generate(numbers, [&] { return uniform(random); });
  numbers.front() = low;
  numbers.back() = high;
  return numbers;
}

/// 2^x of them, all of whose sizes are as frequent.
std::vector<float> of_all_sizes(float low, float high) {
  std::vector<float> numbers = numbers_between(low, high);
  std::ranges::transform(numbers, numbers.begin(), [](float x) { return std::exp2(x); });
  return numbers;
}

/// The largest of error(x, f(x)).
double worst(const std::vector<float>& x, const std::vector<float>& f,
             const std::function<double(double, double)>& error) {
  double worst = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    worst = std::max(worst, std::abs(error(static_cast<double>(x[i]), static_cast<double>(f[i]))));
  return worst;
}

TEST(SimdFunctions, PowersOfTwoAreRightToThreeTenMillionths) {
  const std::vector<float> x = numbers_between(-126, 127);
  std::vector<float> f(x.size());
  exp2_of(x, f);
  EXPECT_LT(worst(x, f, [](double at, double value) { return value / std::exp2(at) - 1; }), 3e-7);
}

TEST(SimdFunctions, PowersOfTwoAreExactAtWholeNumbers) {
  std::vector<float> x;
  for (int whole = -126; whole <= 127; ++whole) x.push_back(static_cast<float>(whole));
  std::vector<float> f(x.size());
  exp2_of(x, f);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_EQ(f[i], std::exp2(x[i])) << x[i];
}

TEST(SimdFunctions, LogarithmsAreRightToTwoTenMillionthsOfTheLargerOfThemAndOne) {
  std::vector<float> x = of_all_sizes(-125, 127);
  const std::vector<float> near_one = numbers_between(0.5, 2);
  x.insert(x.end(), near_one.begin(), near_one.end());
  std::vector<float> f(x.size());
  log2_of(x, f);
  EXPECT_LT(worst(x, f,
                  [](double at, double value) {
                    return (value - std::log2(at)) / std::max(1.0, std::abs(std::log2(at)));
                  }),
            2e-7);
}

TEST(SimdFunctions, PowersAreAsRightAsTheirExponentsSay) {
  for (const float exponent : {1 / 2.4F, 1 / 2.2F, 2.4F, 1.0F, 0.0F, -1.5F}) {
    const std::vector<float> x = of_all_sizes(-20, 20);
    std::vector<float> f(x.size());
    pow_of(x, exponent, f);
    const double p = static_cast<double>(exponent);
    EXPECT_LT(worst(x, f,
                    [p](double at, double value) {
                      return (value / std::pow(at, p) - 1) / (1 + std::abs(p * std::log2(at)));
                    }),
              3e-7)
        << exponent;
  }
}

TEST(SimdFunctions, WhatIsNoNumberStaysNoneWhereItIsClamped) {
  const std::vector<float> x{-2, std::numeric_limits<float>::quiet_NaN(), 0.5F, 7};
  std::vector<float> f(x.size());
  clamp_of(x, 0, 1, f);
  EXPECT_EQ(f[0], 0);
  EXPECT_TRUE(std::isnan(f[1]));
  EXPECT_EQ(f[2], 0.5F);
  EXPECT_EQ(f[3], 1);
}

}  // namespace
}  // namespace patina::testing
