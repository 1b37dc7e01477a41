#include "engine/sampling/noise.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>

#include "engine/sampling/kernels.h"
#include "engine/sampling/rng.h"
#include "engine/sampling/sample.h"
#include "tests/sampling/targets.h"

namespace patina {
namespace {

/// N(0, I) whose value is drawn anew in each evaluation.
class Noisy final : public LogDensity {
 public:
  explicit Noisy(double sd) : sd_(sd) {}
  Eigen::Index dimension() const override { return 2; }
  Evaluation evaluate(const Position& p) const override {
    Rng rng(3, ++calls_);
    return {-0.5 * p.continuous.squaredNorm() + sd_ * rng.normal(), -p.continuous};
  }

 private:
  double sd_;
  mutable std::atomic<std::uint64_t> calls_{0};
};

const Position kPlace{Eigen::Vector2d(0.3, -1), {}};

TEST(Noise, of_a_function_is_zero_to_the_bit_on_any_number_of_threads) {
  const GaussianTarget target(Eigen::Vector2d::Zero(), some_covariance(2));
  EXPECT_EQ(value_noise(target, kPlace, 20), 0);
  EXPECT_EQ(value_noise(target, kPlace, 20, 4), 0);
}

TEST(Noise, is_the_sd_of_the_value) {
  // The relative error of an sd of n values is 1 / sqrt(2 n).
  EXPECT_NEAR(value_noise(Noisy(0.5), kPlace, 2000), 0.5, 0.5 * 4 / std::sqrt(4000.0));
  EXPECT_EQ(value_noise(Noisy(0.5), kPlace, 1), 0);
}

TEST(Noise, outside_the_support_is_zero_and_now_and_then_outside_infinite) {
  const double infinity = std::numeric_limits<double>::infinity();
  const FunctionDensity never(2, [=](const Position&) {
    return Evaluation{-infinity, Eigen::Vector2d::Zero()};
  });
  EXPECT_EQ(value_noise(never, kPlace, 20), 0);
  int calls = 0;
  const FunctionDensity at_times(2, [&](const Position&) {
    return Evaluation{++calls % 3 == 0 ? -infinity : 1.0, Eigen::Vector2d::Zero()};
  });
  EXPECT_EQ(value_noise(at_times, kPlace, 20), infinity);
}

TEST(Noise, is_told_by_a_sample_and_does_not_change_it) {
  const GaussianTarget target(Eigen::Vector2d::Zero(), some_covariance(2));
  const auto kernel = make_kernel("hmc", target, 1);
  const SampleSettings with{.warmup = 50, .draws = 20};
  SampleSettings without = with;
  without.noise_repeats = 0;
  const Sample a = sample(target, *kernel, with), b = sample(target, *kernel, without);
  EXPECT_EQ(a.noise, 0);
  EXPECT_EQ(a.log_density, b.log_density);
  EXPECT_EQ(a.evaluations, b.evaluations);
  const Noisy noisy(0.5);
  EXPECT_GT(sample(noisy, *make_kernel("hmc", noisy, 1), with).noise, kMostNoise);
}

}  // namespace
}  // namespace patina
