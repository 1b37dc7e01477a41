#include "engine/sampling/tempered_sample.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "engine/diagnostics/convergence.h"
#include "engine/sampling/kernels.h"
#include "tests/sampling/targets.h"

namespace patina {
namespace {

const Eigen::Vector3d kModes[] = {{-2, 0, 0}, {1.5, 1, 0}};
constexpr double kWidth = 0.1, kWeights[] = {0.5, 0.5};

/// A prior N(0, I), and a likelihood that is a sum of two narrow Gaussians far apart: so is the posterior.
FunctionDensity two_modes() {
  return {3, [](const Position& p) {
            const Eigen::Vector3d x = p.continuous;
            double logs[2];
            for (int k = 0; k < 2; ++k)
              logs[k] = std::log(kWeights[k]) - 0.5 * (x - kModes[k]).squaredNorm() / (kWidth * kWidth);
            const double top = std::max(logs[0], logs[1]),
                         sum = std::exp(logs[0] - top) + std::exp(logs[1] - top);
            Eigen::Vector3d gradient = -x;
            for (int k = 0; k < 2; ++k)
              gradient -= std::exp(logs[k] - top) / sum * (x - kModes[k]) / (kWidth * kWidth);
            return Evaluation{-0.5 * x.squaredNorm() + top + std::log(sum), gradient};
          }};
}

/// Posterior probability of the first mode: prior predictive density of each, N(mode; 0, (1 + width^2) I).
double first_modes_weight() {
  double weights[2];
  for (int k = 0; k < 2; ++k)
    weights[k] = kWeights[k] * std::exp(-0.5 * kModes[k].squaredNorm() / (1 + kWidth * kWidth));
  return weights[0] / (weights[0] + weights[1]);
}

Eigen::MatrixXd in_first_mode(const Sample& sample) {
  return (sample.coordinates[0].array() < 0).cast<double>();
}

TEST(SampleTempered, weighs_two_modes_that_chains_by_themselves_do_not_leave) {
  const FunctionDensity target = two_modes();
  const auto kernel = make_kernel("hmc", target, 1);
  const SampleSettings settings{.chains = 4, .warmup = 800, .draws = 3000, .seed = 7};

  const Eigen::MatrixXd plain = in_first_mode(sample(target, *kernel, settings));
  for (const auto chain : plain.colwise())
    EXPECT_EQ(chain.minCoeff(), chain.maxCoeff()) << "a chain crossed by itself, or this shows nothing";

  const TemperedSample tempered = sample_tempered(target, *kernel, settings, 8);
  const Eigen::MatrixXd first = in_first_mode(tempered.sample);
  EXPECT_LT(mcse_mean(first), 0.03);
  EXPECT_LT(std::abs(first.mean() - first_modes_weight()) / mcse_mean(first), 4);
  EXPECT_LT(split_rhat(tempered.sample.coordinates[0]), 1.03);
  for (const std::int64_t trips : tempered.round_trips) EXPECT_GT(trips, 50);
  const auto [least, most] = std::ranges::minmax(tempered.swap_rejection);
  EXPECT_LT(most - least, 0.2);
  EXPECT_LT(most, 0.8);
  EXPECT_GT(tempered.barrier(), 1);

  // The second coordinate is mode[1] / (1 + width^2) on average in each mode.
  const Eigen::MatrixXd& y = tempered.sample.coordinates[1];
  const double expected = (1 - first_modes_weight()) * kModes[1][1] / (1 + kWidth * kWidth);
  EXPECT_LT(std::abs(y.mean() - expected) / mcse_mean(y), 4);
}

TEST(SampleTempered, weighs_levels_that_no_discrete_move_changes) {
  // Each of three levels has its own narrow place, far from the others'.
  const FunctionDensity target(
      2,
      [](const Position& p) {
        const Eigen::Vector2d centre(1.5 * (p.discrete[0] - 1), 0), off = p.continuous - centre;
        return Evaluation{-0.5 * p.continuous.squaredNorm() - 0.5 * off.squaredNorm() / 0.01,
                          -p.continuous - off / 0.01};
      },
      {3});
  const auto kernel = make_kernel("mala", target, 0.8);
  const SampleSettings settings{.chains = 4, .warmup = 800, .draws = 4000, .seed = 8};
  const Eigen::MatrixXd plain = sample(target, *kernel, settings).levels[0];
  for (const auto chain : plain.colwise()) EXPECT_EQ(chain.minCoeff(), chain.maxCoeff());
  const TemperedSample tempered = sample_tempered(target, *kernel, settings, 8);
  const double aside = std::exp(-0.5 * 1.5 * 1.5 / 1.01);
  const Eigen::MatrixXd middle = (tempered.sample.levels[0].array() == 1).cast<double>();
  EXPECT_LT(mcse_mean(middle), 0.03);
  EXPECT_LT(std::abs(middle.mean() - 1 / (1 + 2 * aside)) / mcse_mean(middle), 4);
}

TEST(SampleTempered, depends_on_its_seed_alone_and_counts_what_it_evaluates) {
  std::atomic<long> evaluations{0};
  const FunctionDensity counted(3, [&, target = two_modes()](const Position& p) {
    ++evaluations;
    return target.evaluate(p);
  });
  const auto kernel = make_kernel("nuts", counted, 1);
  SampleSettings settings{.chains = 3, .warmup = 60, .draws = 50, .seed = 9};
  const TemperedSample one = sample_tempered(counted, *kernel, settings, 4);
  const long with_warmup = evaluations.exchange(0);
  settings.threads = 3;
  const TemperedSample three = sample_tempered(counted, *kernel, settings, 4);
  EXPECT_EQ(evaluations, with_warmup);
  EXPECT_EQ(one.sample.coordinates, three.sample.coordinates);
  EXPECT_EQ(one.betas, three.betas);
  EXPECT_EQ(one.round_trips, three.round_trips);
  settings.seed = 10;
  EXPECT_NE(one.sample.coordinates, sample_tempered(counted, *kernel, settings, 4).sample.coordinates);
  settings.warmup = 0;
  evaluations = 0;
  const long of_sample = sample_tempered(counted, *kernel, settings, 4).sample.evaluations;
  EXPECT_EQ(evaluations, of_sample + 3 * 4 + settings.noise_repeats) << "starts, and a look at its noise";
}

TEST(SampleTempered, refuses_what_is_no_ladder_and_a_prior_that_never_meets_the_target) {
  const FunctionDensity target = two_modes();
  EXPECT_THROW(sample_tempered(target, *make_hmc(), {}, 1), std::invalid_argument);
  const FunctionDensity nowhere(1, [](const Position&) {
    return Evaluation{-std::numeric_limits<double>::infinity(), Eigen::VectorXd::Zero(1)};
  });
  EXPECT_THROW(sample_tempered(nowhere, *make_hmc(), {}, 3), std::invalid_argument);
}

}  // namespace
}  // namespace patina
