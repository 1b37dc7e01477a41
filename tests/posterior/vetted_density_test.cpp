#include "engine/posterior/vetted_density.h"

#include <ATen/Parallel.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "engine/diagnostics/convergence.h"
#include "engine/material/irregularities.h"
#include "engine/posterior/emulate.h"
#include "engine/posterior/emulated_moves.h"
#include "engine/posterior/irregularity_pool.h"
#include "engine/sampling/function_density.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/map_search.h"
#include "engine/sampling/rng.h"
#include "engine/sampling/sample.h"
#include "tests/posterior/few_free.h"

namespace patina {
namespace {

/// Polynomials of the standard normal: residuals are zero everywhere.
Emulator of_the_prior() {
  Rng rng(3);
  Eigen::MatrixXd places(2, 60);
  for (auto place : places.colwise()) place = rng.normals(2);
  return Emulator({places, Eigen::MatrixXd::Zero(60, 60)});
}

/// The standard normal with one more coordinate that nothing is known of, and a cliff at u_0 = 1 that the
/// polynomials know nothing of.
std::shared_ptr<const LogDensity> with_cliff() {
  return std::make_shared<FunctionDensity>(3, [](const Position& p) {
    const Eigen::VectorXd& u = p.continuous;
    const double beyond = std::max(u[0] - 1, 0.0);
    Evaluation e{-u.squaredNorm() / 2 - 200 * beyond, -u};
    if (beyond > 0) e.gradient[0] -= 200;
    return e;
  });
}

VettedDensity vetted(double allowance) { return {{of_the_prior(), allowance, {}}, with_cliff(), {0, 1}}; }

TEST(VettedDensity, IsTheLesserOfWhatPolynomialsSayAndWhatARenderAllows) {
  const VettedDensity density = vetted(3);
  Position near{Eigen::Vector3d(0.5, -0.3, 0.8), {}}, far{Eigen::Vector3d(1.5, -0.3, 0.8), {}};
  EXPECT_NEAR(density.evaluate(near).log_density, -near.continuous.squaredNorm() / 2, 1e-9);
  EXPECT_NEAR(density.evaluate(far).log_density, with_cliff()->evaluate(far).log_density + 3, 1e-9);
  for (const Position& at : {near, far}) {
    const Evaluation here = density.evaluate(at);
    EXPECT_EQ(density.value(at).log_density, here.log_density);
    for (Eigen::Index i = 0; i < 3; ++i) {
      constexpr double kStep = 1e-5;
      Position up = at, down = at;
      up.continuous[i] += kStep, down.continuous[i] -= kStep;
      EXPECT_NEAR(here.gradient[i],
                  (density.value(up).log_density - density.value(down).log_density) / (2 * kStep), 1e-4);
    }
  }
}

TEST(VettedDensity, ItsDrawsAreThoseOfATruncatedNormalWherePolynomialsPromiseWhatIsNotThere) {
  const VettedDensity density = vetted(1);
  const auto kernel = make_emulated_kernel(density, 1.5);
  SampleSettings settings;
  settings.warmup = 150;
  settings.draws = 3000;
  settings.noise_repeats = 0;
  const Sample sample = patina::sample(density, *kernel, settings);
  const Eigen::MatrixXd& x = sample.coordinates[0];
  // Of N(0, 1) below 1: the render's veto begins 1/200 nats beyond.
  const double phi = std::exp(-0.5) / std::sqrt(2 * M_PI), share = 0.5 * std::erfc(-1 / std::sqrt(2.0));
  EXPECT_LT(split_rhat(x), 1.01);
  EXPECT_NEAR(x.mean(), -phi / share, 4 * mcse_mean(x) + 0.01);
  EXPECT_LT(x.maxCoeff(), 1.1);
  EXPECT_GT(bulk_ess(x), 3000) << "of 12000";
}

TEST(VettedDensity, RefusesWhatIsNotANumber) {
  Position nowhere{Eigen::Vector3d(NAN, 0, 0), {}};
  EXPECT_FALSE(vetted(1).value(nowhere).log_density > -1e300);
}

/// A bumpy surface by Gram matrices, of which other bumps make others, where eight z are all that there are.
class Average : public testing::Test {
 protected:
  explicit Average(Posterior posterior = with_free("bump", {"light", "rough"}, "gram"))
      : posterior_(std::move(posterior)) {}

  std::optional<AveragedEmulator> learnt(EmulateSettings settings = {}) {
    return learnt_from(pool_, std::move(settings));
  }
  std::optional<AveragedEmulator> learnt_from(IrregularityPool& pool, EmulateSettings settings = {}) {
    settings.most = 400;
    settings.threads = 2;
    settings.enter_thread = [] { at::set_num_threads(1); };
    settings.others = &pool;
    return emulate_average(posterior_, {{mode_, posterior_.value(mode_)}}, laplace_, settings);
  }

  /// How much more it allows than a nat above what the better quarter of polynomials' draws have, by renders
  /// of the pool.
  double allowed_beyond_a_nat(const AveragedEmulator& average, IrregularityPool& pool) {
    SampleSettings settings;
    settings.warmup = 150;
    settings.draws = 100;
    settings.noise_repeats = 0;
    const auto kernel = make_kernel("hmc", average.emulator, 1, 0, "joint", 1.5);
    const Sample sample = patina::sample(average.emulator, *kernel, settings);
    std::vector<double> deeper;
    for (Eigen::Index i = 0; i < sample.log_density.size(); ++i) {
      const Position at{Eigen::Vector2d(sample.coordinates[0](i), sample.coordinates[1](i)), {}};
      const Posterior shown = posterior_.with(pool[static_cast<std::uint64_t>(i)]);
      deeper.push_back(sample.log_density(i) - shown.value(at).log_density);
    }
    std::ranges::sort(deeper);
    return average.allowance - (deeper[deeper.size() / 4] - 1);
  }

  /// Log densities with each z, and that of their mean residuals.
  std::vector<double> each(const Position& at) {
    std::vector<double> each;
    for (std::size_t k = 0; k < kMany; ++k) each.push_back(posterior_.with(pool_[k]).value(at).log_density);
    return each;
  }
  double of_the_mean(const Position& at) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(posterior_.photo_summary().size());
    for (std::size_t k = 0; k < kMany; ++k) sum += posterior_.with(pool_[k]).predicted(at);
    const Eigen::VectorXd mean =
        sum / static_cast<double>(kMany) - posterior_.in_errors(posterior_.photo_summary());
    return -(at.continuous.squaredNorm() + mean.squaredNorm()) / 2;
  }

  static constexpr std::size_t kMany = 8;
  Posterior posterior_;
  Position mode_{Eigen::VectorXd::Zero(2), {}};
  Metric laplace_{laplace_covariance(posterior_, mode_)};
  IrregularityPool pool_{7000, kMany};
};

TEST_F(Average, IsThatOfAllIrregularitiesAndNoneOfTheirLuck) {
  constexpr int kSeeds = 4, kPlaces = 8;
  std::vector<AveragedEmulator> averages;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) averages.push_back(learnt({.seed = seed}).value());
  Rng rng(5);
  double off = 0, luck = 0;
  for (int i = 0; i < kPlaces; ++i) {
    const Position at{mode_.continuous + 0.7 * laplace_.colour(rng.normals(2)), {}};
    const double mean = of_the_mean(at);
    for (const AveragedEmulator& average : averages)
      off += std::abs(average.emulator.evaluate(at).log_density - mean) / kSeeds;
    for (const double one : each(at)) luck += std::abs(one - mean) / kMany;
  }
  EXPECT_LT(off, 0.4 * luck);
}

/// Whose renders differ by a nat or two by how their rings waver.
class AverageOfWood : public Average {
 protected:
  AverageOfWood() : Average(with_free("wood", {"light", "rough"}, "covariances")) {}
};

TEST_F(AverageOfWood, AllowsMoreWhereARenderIsAMatterOfLuck) {
  IrregularityPool one(7000, 1), many(7000, 64);
  constexpr int kSeeds = 4;  // a quantile of the few draws that are checked is a tenth of the luck off
  double of_one = 0, of_many = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    of_one += allowed_beyond_a_nat(learnt_from(one, {.seed = seed}).value(), one) / kSeeds;
    of_many += allowed_beyond_a_nat(learnt_from(many, {.seed = seed}).value(), many) / kSeeds;
  }
  Eigen::ArrayXd lp(64);
  for (Eigen::Index k = 0; k < lp.size(); ++k)
    lp[k] = posterior_.with(many[static_cast<std::uint64_t>(k)]).value(mode_).log_density;
  const double luck = std::sqrt((lp - lp.mean()).square().mean());
  EXPECT_GT(luck, 1);
  EXPECT_NEAR(of_one, 0, 0.1 * luck);
  EXPECT_NEAR(of_many, luck / 3, 0.15 * luck);
}

TEST_F(Average, IsTheSameWhateverTheThreadsDoAndNoneWhereTooFewOfItsDrawsAreWhereItSays) {
  const auto once = learnt(), again = learnt();
  ASSERT_TRUE(once && again);
  EXPECT_EQ(once->emulator.evaluate(mode_).log_density, again->emulator.evaluate(mode_).log_density);
  EXPECT_EQ(once->allowance, again->allowance);
  EXPECT_TRUE(once->is_of(2, 2));
  EXPECT_FALSE(once->is_of(3, 2));
  EXPECT_FALSE(learnt({.poor = 1.01}));
}

}  // namespace
}  // namespace patina
