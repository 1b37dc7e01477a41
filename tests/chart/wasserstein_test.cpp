#include "engine/chart/wasserstein.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/diagnostics/convergence.h"
#include "tests/chart/autoregression.h"

namespace patina {
namespace {

TEST(Wasserstein, of_few_points_is_the_area_between_their_steps) {
  EXPECT_DOUBLE_EQ(wasserstein_1({0, 1}, {0, 3}), 1);
  EXPECT_DOUBLE_EQ(wasserstein_1({0, 3}, {0, 1}), 1);
  EXPECT_DOUBLE_EQ(wasserstein_1({0}, {0, 1}), 0.5);
  EXPECT_DOUBLE_EQ(wasserstein_1({-2, -1}, {5}), 6.5);
  EXPECT_DOUBLE_EQ(wasserstein_1({1, 2, 2, 4}, {1, 2, 2, 4}), 0);
}

/// Of N(0, 1) and N(shift, scale^2) where one of the two is as in N(0, 1).
double closed_form(double shift, double scale) {
  return shift != 0 ? std::abs(shift) : std::abs(scale - 1) * std::sqrt(2 / std::numbers::pi);
}

TEST(Wasserstein, of_shifted_and_of_scaled_normals_is_the_closed_form_within_its_bar) {
  Rng rng(1);
  for (const auto& [shift, scale] : {std::pair(0.3, 1.0), {-1.0, 1.0}, {0.0, 1.4}, {0.0, 0.6}}) {
    const Eigen::MatrixXd a = autoregressive_draws(3000, 4, 0.5, rng);
    const Eigen::MatrixXd b = shift + scale * autoregressive_draws(2000, 3, 0.7, rng).array();
    const BlockedSample first(a, mean_ess(a)), second(b, mean_ess(b));
    const double bar = std::hypot(first.distance_to_law(rng), second.distance_to_law(rng));
    const double distance = wasserstein_1(first.sorted(), second.sorted());
    EXPECT_NEAR(distance, closed_form(shift, scale), 3 * bar) << shift << " " << scale;
    EXPECT_GT(distance, 3 * bar) << "and is told from none";
  }
}

/// The normal law as a sample: its quantiles, evenly spread.
std::vector<double> quantiles_of_normal() {
  constexpr int kPoints = 20000;
  std::vector<double> quantiles;
  for (int i = 0; i < kPoints; ++i) {
    const double p = (i + 0.5) / kPoints;
    double low = -9, high = 9;
    while (high - low > 1e-9) {
      const double middle = (low + high) / 2;
      (0.5 * std::erfc(-middle / std::numbers::sqrt2) < p ? low : high) = middle;
    }
    quantiles.push_back(low);
  }
  return quantiles;
}

struct Distances {
  double estimated = 0, actual = 0;  ///< root mean squares over samples
};

Distances distances_to_normal(double rho, bool knows_its_memory) {
  constexpr int kSamples = 40;
  const std::vector<double> law = quantiles_of_normal();
  Rng rng(2);
  Distances sums;
  for (int i = 0; i < kSamples; ++i) {
    const Eigen::MatrixXd draws = autoregressive_draws(1000, 4, rho, rng);
    const BlockedSample sample(draws, knows_its_memory ? mean_ess(draws) : draws.size());
    sums.estimated += std::pow(sample.distance_to_law(rng), 2) / kSamples;
    sums.actual += std::pow(wasserstein_1(sample.sorted(), law), 2) / kSamples;
  }
  return {std::sqrt(sums.estimated), std::sqrt(sums.actual)};
}

TEST(Wasserstein, a_sample_knows_how_far_it_is_from_its_law) {
  for (const double rho : {0.0, 0.5, 0.9}) {
    const auto [estimated, actual] = distances_to_normal(rho, true);
    EXPECT_NEAR(estimated / actual, 1, 0.2) << rho;
  }
}

TEST(Wasserstein, draws_taken_for_independent_that_are_not_believe_themselves_too_near) {
  const auto [estimated, actual] = distances_to_normal(0.9, false);
  EXPECT_LT(estimated / actual, 0.65);
}

}  // namespace
}  // namespace patina
