#include "engine/posterior/emulate.h"

#include <ATen/Parallel.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/diagnostics/convergence.h"
#include "engine/material/renderer.h"
#include "engine/sampling/archive.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/map_search.h"
#include "engine/sampling/sample.h"

namespace patina {
namespace {

constexpr Eigen::Index kDimension = 3;

Eigen::VectorXd residuals_at(const Eigen::VectorXd& u, bool cubic) {
  Eigen::VectorXd r(4);
  r << 2 * u[0] - u[1] + 0.3, u[0] * u[2] - 0.5 * u[1] * u[1], u[2] + 0.2 * u[1], 0.7;
  if (cubic) r[3] += 0.1 * u[0] * u[0] * u[0];
  return r;
}

double exact(const Eigen::VectorXd& u, bool cubic) {
  return -u.squaredNorm() / 2 - residuals_at(u, cubic).squaredNorm() / 2;
}

EmulatorExamples examples_of(bool cubic, std::uint64_t seed = 3) {
  Rng rng(seed);
  EmulatorExamples examples{Eigen::MatrixXd(kDimension, 80), Eigen::MatrixXd(4, 80)};
  for (Eigen::Index i = 0; i < examples.count(); ++i) {
    examples.places.col(i) = rng.normals(kDimension);
    examples.residuals.col(i) = residuals_at(examples.places.col(i), cubic);
  }
  return examples;
}

TEST(Emulator, OfASummaryThatIsAPolynomialIsThePosteriorUpToTheRidge) {
  const Emulator emulator(examples_of(/*cubic=*/false));
  Rng rng(4);
  for (int i = 0; i < 20; ++i) {
    const Eigen::VectorXd u = rng.normals(kDimension);
    const double truth = exact(u, false);
    EXPECT_NEAR(emulator.evaluate({u, {}}).log_density, truth, 0.01 * (1 + std::abs(truth)));
  }
}

/// Of coordinates, and of parameters' logarithms, one with a bound below zero.
const LogParameters kAxes[] = {{}, LogParameters({{0.4, 0.3, 0, 1}, {5, 2, 0, 10}, {0, 0.5, -1, 1}})};

TEST(LogParameters, DerivativesEqualCentralDifferencesAndRestAtBounds) {
  Rng rng(9);
  for (int i = 0; i < 10; ++i) {
    constexpr double kStep = 1e-6;
    const Eigen::VectorXd u = 2 * rng.normals(kDimension),
                          step = Eigen::VectorXd::Constant(kDimension, kStep);
    const Eigen::VectorXd differences = (kAxes[1].values(u + step) - kAxes[1].values(u - step)) / (2 * kStep);
    EXPECT_LT((kAxes[1].derivatives(u) - differences).norm(), 1e-5 * (1 + differences.norm()));
  }
  const Eigen::VectorXd far = Eigen::VectorXd::Constant(kDimension, 5);
  EXPECT_LT((kAxes[1].values(far) - kAxes[1].values(1.2 * far)).norm(), 1e-3);
}

class EmulatorOn : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Axes, EmulatorOn, testing::Values(0, 1));

TEST_P(EmulatorOn, GradientEqualsCentralDifferences) {
  const Emulator emulator(examples_of(/*cubic=*/true), kAxes[GetParam()]);
  Rng rng(5);
  for (int i = 0; i < 10; ++i) {
    const Eigen::VectorXd u = 1.5 * rng.normals(kDimension), gradient = emulator.evaluate({u, {}}).gradient;
    for (Eigen::Index k = 0; k < kDimension; ++k) {
      constexpr double kStep = 1e-5;
      Eigen::VectorXd up = u, down = u;
      up[k] += kStep, down[k] -= kStep;
      const double difference =
          (emulator.evaluate({up, {}}).log_density - emulator.evaluate({down, {}}).log_density) / (2 * kStep);
      EXPECT_NEAR(gradient[k], difference, 1e-5 * (1 + std::abs(difference)));
    }
  }
}

TEST(Emulator, SoftenedKeepsThePriorAndTakesTheLikelihoodsPower) {
  const Emulator emulator(examples_of(/*cubic=*/true), kAxes[1]);
  const Emulator soft = emulator.softened(0.8);
  const Eigen::VectorXd u = Eigen::VectorXd::Constant(kDimension, 0.7);
  const double prior = -u.squaredNorm() / 2;
  EXPECT_NEAR(soft.evaluate({u, {}}).log_density - prior,
              0.8 * (emulator.evaluate({u, {}}).log_density - prior), 1e-12);
}

TEST(Emulator, NeverPromisesMoreThanAPerfectMatchHoweverFarAway) {
  const Emulator emulator(examples_of(/*cubic=*/true));
  Rng rng(6);
  for (int i = 0; i < 200; ++i) {
    const Eigen::VectorXd u = 20 * rng.normals(kDimension);
    EXPECT_LE(emulator.evaluate({u, {}}).log_density, -u.squaredNorm() / 2 + 1e-6 * u.squaredNorm());
  }
}

TEST(Emulator, IsTheSameFromItsArchiveAndOneOfAnotherSizeIsSeen) {
  Emulator emulator(examples_of(/*cubic=*/true), kAxes[1]), read;
  Archive written;
  written(emulator);
  Archive archive(written.take_bytes());
  archive(read);
  archive.expect_end();
  const Position position{Eigen::VectorXd::Constant(kDimension, 0.4), {}};
  EXPECT_EQ(read.evaluate(position).log_density, emulator.evaluate(position).log_density);
  EXPECT_TRUE(read.is_of(kDimension));
  EXPECT_FALSE(read.is_of(kDimension + 1));
  EXPECT_FALSE(Emulator().is_of(kDimension));
}

/// bump by its mean colours at 32 pixels, three parameters free.
class EmulatedPosterior : public testing::Test {
 protected:
  static Posterior posterior() {
    const Renderer renderer("bump", 2, Capture{});
    const ParameterValues usual = prior_location(renderer.table());
    PosteriorSettings settings;
    settings.resolution = 32;
    settings.summary = "means";
    for (std::size_t i = 0; i < usual.continuous.size(); ++i) {
      const std::string& name = renderer.table().continuous[i].name;
      if (name != "light" && name != "albedo_r" && name != "rough")
        settings.fixed[name] = usual.continuous[i];
    }
    return Posterior(settings, renderer.render(usual, 32));
  }

  static EmulateSettings usual() {
    return {.threads = 2, .enter_thread = [] { at::set_num_threads(1); }};
  }

  Posterior posterior_ = posterior();
  Position mode_{Eigen::VectorXd::Zero(3), {}};
  Metric laplace_{laplace_covariance(posterior_, mode_)};
};

TEST_F(EmulatedPosterior, IsLearntToAFractionOfANatFromAFewHundredEvaluations) {
  const Emulation made = emulate(posterior_, mode_, laplace_, usual());
  ASSERT_TRUE(made.emulator) << made.error;
  EXPECT_LE(made.error, usual().good);
  EXPECT_LE(made.evaluations, usual().most);
  EXPECT_EQ(emulate(posterior_, mode_, laplace_, usual()).emulator->evaluate(mode_).log_density,
            made.emulator->evaluate(mode_).log_density)
      << "whatever the threads do";
}

TEST_F(EmulatedPosterior, IsRefusedWhereItsErrorStaysPoor) {
  EmulateSettings strict = usual();
  strict.good = strict.poor = 1e-9;
  strict.most = 150;
  const Emulation made = emulate(posterior_, mode_, laplace_, strict);
  EXPECT_FALSE(made.emulator);
  EXPECT_GT(made.error, 1e-9);
}

TEST_F(EmulatedPosterior, IsToldFromOneThatHasAnotherModeByWhatASearchFoundThere) {
  const Emulation made = emulate(posterior_, mode_, laplace_, usual());
  ASSERT_TRUE(made.emulator);
  const ChainState mode{mode_, posterior_.evaluate(mode_)};
  const auto at = [&](const Eigen::VectorXd& u) { return ChainState{{u, {}}, posterior_.evaluate({u, {}})}; };
  const ChainState near = at(laplace_.colour(Eigen::VectorXd::Constant(3, 0.5)));
  EXPECT_FALSE(misses_one(*made.emulator, mode, {near, at(Eigen::VectorXd::Constant(3, 2))}));
  ChainState other = at(Eigen::VectorXd::Constant(3, 2));
  other.evaluation.log_density = mode.evaluation.log_density - 1;
  EXPECT_TRUE(misses_one(*made.emulator, mode, {near, other}));
}

TEST_F(EmulatedPosterior, DrawsOfItsKernelAreThoseOfHmcAtATenthOfTheRenders) {
  const Emulation made = emulate(posterior_, mode_, laplace_, usual());
  ASSERT_TRUE(made.emulator);
  SampleSettings settings;
  settings.warmup = 300;
  settings.draws = 1500;
  settings.threads = 2;
  settings.noise_repeats = 0;
  settings.enter_thread = [] { at::set_num_threads(1); };
  const auto start = [&](Rng&) { return mode_; };
  const Sample emulated =
      sample(posterior_, *make_emulated_kernel(*made.emulator, posterior_, 1.5), settings, start, laplace_);
  const Sample plain =
      sample(posterior_, *make_kernel("hmc", posterior_, 1, 0.25, "joint", 1.5), settings, start, laplace_);
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::MatrixXd &x = emulated.coordinates[i], &y = plain.coordinates[i];
    EXPECT_LT(split_rhat(x), 1.02);
    EXPECT_NEAR(x.mean(), y.mean(), 4 * std::hypot(mcse_mean(x), mcse_mean(y)));
    EXPECT_NEAR(standard_deviation(x), standard_deviation(y), 4 * std::hypot(mcse_sd(x), mcse_sd(y)));
    EXPECT_GT(bulk_ess(x), 1500) << "of 6000";
  }
}

TEST(CanEmulate, NeitherPlacesOfATextureNorChoices) {
  const auto can = [](const std::string& material) {
    const Renderer renderer(material, 2, Capture{});
    PosteriorSettings settings;
    settings.material = material;
    settings.resolution = 32;
    settings.summary = "means";
    return can_emulate(Posterior(settings, renderer.render(prior_location(renderer.table()), 32)));
  };
  EXPECT_TRUE(can("bump"));
  EXPECT_TRUE(can("metal"));
  EXPECT_TRUE(can("translucent"));
  EXPECT_FALSE(can("leather"));
  EXPECT_FALSE(can("flake"));
}

}  // namespace
}  // namespace patina
