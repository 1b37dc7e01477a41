#include "engine/sampling/evolution.h"

#include <gtest/gtest.h>

#include <Eigen/QR>

#include <cmath>
#include <limits>

#include "engine/sampling/function_density.h"
#include "tests/sampling/targets.h"

namespace patina {
namespace {

constexpr Eigen::Index kDimension = 8;

Position origin() { return {Eigen::VectorXd::Zero(kDimension), {}}; }

/// Sds from 0.02 to 2 along axes that are turned against the coordinates'.
Eigen::MatrixXd thin_covariance() {
  Eigen::VectorXd variances(kDimension);
  for (Eigen::Index i = 0; i < kDimension; ++i)
    variances[i] = 4 * std::pow(1e-4, static_cast<double>(i) / (kDimension - 1));
  Rng rng(5);
  Eigen::MatrixXd any(kDimension, kDimension);
  for (auto column : any.colwise()) column = rng.normals(kDimension);
  const Eigen::MatrixXd axes = Eigen::HouseholderQR<Eigen::MatrixXd>(any).householderQ();
  return axes * variances.asDiagonal() * axes.transpose();
}

GaussianTarget thin_gaussian() { return {Eigen::VectorXd::Constant(kDimension, 1), thin_covariance()}; }

TEST(Evolution, climbs_a_ridge_a_hundred_times_as_long_as_wide_without_a_gradient) {
  const GaussianTarget target = thin_gaussian();
  for (const int seed : {1, 2, 3, 4, 5}) {
    Rng rng(seed);
    const OptimizerResult best = evolve(target, origin(), rng, {.generations = 300});
    EXPECT_GT(best.evaluation.log_density, -0.5) << "seed " << seed;
    EXPECT_EQ(best.evaluation.log_density, target.evaluate(best.position).log_density);
  }
}

TEST(Evolution, that_is_told_of_the_ridge_it_begins_on_need_not_learn_it) {
  const GaussianTarget target = thin_gaussian();
  const Eigen::MatrixXd root = thin_covariance().llt().matrixL();
  const auto found = [&](int seed, const Eigen::MatrixXd& shape) {
    Rng rng(seed);
    const Position start{Eigen::VectorXd::Ones(kDimension) + 2 * root * rng.normals(kDimension), {}};
    return evolve(target, start, rng, {.shape = shape, .generations = 20}).evaluation.log_density;
  };
  for (const int seed : {1, 2, 3, 4, 5}) {
    EXPECT_GT(found(seed, thin_covariance()), -0.5) << "seed " << seed;
    EXPECT_LT(found(seed, {}), -1) << "seed " << seed;
  }
}

/// A bowl of wrinkles: each is a basin for a climb, and two nats high.
FunctionDensity wrinkled() {
  return {kDimension, [](const Position& position) {
            const Eigen::ArrayXd apart = position.continuous.array() - 1;
            return Evaluation{(-5 * apart.square() + 2 * (30 * apart).cos() - 2).sum(),
                              -10 * apart - 60 * (30 * apart).sin()};
          }};
}

TEST(Evolution, passes_over_wrinkles_that_stop_a_climb) {
  const FunctionDensity target = wrinkled();
  EXPECT_LT(maximize(target, origin()).evaluation.log_density, -30) << "a climb should end where it began";
  for (const int seed : {1, 2, 3, 4, 5}) {
    Rng rng(seed);
    EXPECT_GT(evolve(target, origin(), rng, {}).evaluation.log_density, -8) << "seed " << seed;
  }
}

TEST(Evolution, is_decided_by_its_seed_on_any_number_of_threads) {
  const FunctionDensity target = wrinkled();
  const auto found = [&](int seed, int threads) {
    Rng rng(seed);
    return evolve(target, origin(), rng, {.generations = 20, .threads = threads}).position.continuous;
  };
  EXPECT_EQ(found(1, 1), found(1, 4));
  EXPECT_NE(found(1, 1), found(2, 1));
}

TEST(Evolution, goes_round_what_has_no_density_and_keeps_levels) {
  constexpr double kNothing = -std::numeric_limits<double>::infinity();
  const FunctionDensity target{kDimension,
                               [](const Position& position) {
                                 const Eigen::VectorXd& x = position.continuous;
                                 const bool inside = x[0] > 0.2 && position.discrete[0] == 2;
                                 const double density = inside ? -5 * x.squaredNorm() : kNothing;
                                 return Evaluation{x[1] > 1 ? NAN : density, Eigen::VectorXd::Zero(x.size())};
                               },
                               {3}};
  Rng rng(1);
  const Position start{Eigen::VectorXd::Zero(kDimension), Eigen::VectorXi::Constant(1, 2)};
  const OptimizerResult best = evolve(target, start, rng, {});
  EXPECT_EQ(best.position.discrete[0], 2);
  EXPECT_NEAR(best.evaluation.log_density, -5 * 0.04, 0.05);
}

TEST(Evolution, ends_when_it_is_asked_to_and_when_a_generation_has_shrunk_to_a_point) {
  const GaussianTarget target(Eigen::VectorXd::Zero(kDimension),
                              1e-6 * Eigen::MatrixXd::Identity(kDimension, kDimension));
  Rng rng(1);
  EvolutionSettings settings{.generations = 1'000'000};
  EXPECT_LT(evolve(target, origin(), rng, settings).evaluations, 100'000);
  int generations = 0;
  settings.stop_requested = [&] { return generations == 3; };
  settings.evolved = [&](const OptimizerResult&) { ++generations; };
  EXPECT_EQ(evolve(target, origin(), rng, settings).evaluations, 1 + 3 * settings.population);
}

}  // namespace
}  // namespace patina
