#include "engine/posterior/emulate.h"

#include <ATen/Parallel.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "engine/diagnostics/convergence.h"
#include "engine/posterior/emulated_moves.h"
#include "engine/posterior/informed_density.h"
#include "engine/posterior/known_residuals.h"
#include "engine/sampling/archive.h"
#include "engine/sampling/function_density.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/map_search.h"
#include "engine/sampling/sample.h"
#include "tests/posterior/few_free.h"

namespace patina {
namespace {

constexpr Eigen::Index kDimension = 3;

Eigen::VectorXd residuals_at(const Eigen::VectorXd& u, bool cubic) {
  Eigen::VectorXd r(4);
  r << 2 * u[0] - u[1] + 0.3, u[0] * u[2] - 0.5 * u[1] * u[1], u[2] + 0.2 * u[1], 0.7;
  if (cubic) r[3] += 0.1 * u[0] * u[0] * u[0] + 0.2 * u[0] * u[1] * u[2];
  return r;
}

double exact(const Eigen::VectorXd& u, bool cubic) {
  return -u.squaredNorm() / 2 - residuals_at(u, cubic).squaredNorm() / 2;
}

EmulatorExamples examples_of(bool cubic, std::uint64_t seed = 3) {
  constexpr int kExamples = 80;
  Rng rng(seed);
  Eigen::MatrixXd places(kDimension, kExamples), residuals(4, kExamples);
  for (Eigen::Index i = 0; i < kExamples; ++i) {
    places.col(i) = rng.normals(kDimension);
    residuals.col(i) = residuals_at(places.col(i), cubic);
  }
  return {places, residuals.transpose() * residuals};
}

TEST(Emulator, OfASummaryThatIsAPolynomialIsThePosteriorUpToTheRidge) {
  const Emulator emulator(examples_of(/*cubic=*/false));
  Rng rng(4);
  int followed = 0;
  for (int i = 0; i < 40; ++i) {
    const Eigen::VectorXd u = rng.normals(kDimension);
    const double truth = exact(u, false);
    if (-truth - u.squaredNorm() / 2 > 2 * kDimension) continue;  // nats, from where it is flatter
    EXPECT_NEAR(emulator.evaluate({u, {}}).log_density, truth, 0.01 * (1 + std::abs(truth)));
    ++followed;
  }
  EXPECT_GT(followed, 20);
}

/// Of coordinates, and of parameters' logarithms, one with a bound below zero.
const LogParameters kAxes[] = {
    {}, LogParameters({{0.4, 0.3, 0, 1}, {5, 2, 0, 10}, {0, 0.5, -1, 1}}, Eigen::Vector3d(0.01, 0.1, 0.02))};

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

TEST(LogParameters, AreLogarithmsOfWhatIsKnownToBeSmallAndNearlyThemselvesWhereZeroIsPossible) {
  const std::vector<TruncatedNormal> priors(2, {0.1, 0.5, 0, 2});
  const auto coordinate = [&](double value) { return PriorTransform(priors[0]).coordinate(value); };
  const double small = coordinate(0.05), open = coordinate(0.6);
  const LogParameters axes = LogParameters::about(priors, Eigen::Vector2d(small, open),
                                                  Eigen::Vector2d(0.02, coordinate(1.8) - open));
  const auto step = [&](Eigen::Index i, double from, double to) {
    const auto at = [&](double value) {
      return axes.values(Eigen::Vector2d::Constant(coordinate(value)))[i];
    };
    return at(to) - at(from);
  };
  EXPECT_NEAR(step(0, 0.04, 0.08) / std::log(2), 1, 0.15) << "known to be 0.05";
  EXPECT_LT(step(1, 0, 0.04), 0.3) << "anything from 0 to 1.8";
  EXPECT_GT(step(0, 0, 0.04), 1.5) << "for the one that is known it is far";
}

using AxesAndSides = std::tuple<int, std::optional<Eigen::Index>>;
class EmulatorOn : public testing::TestWithParam<AxesAndSides> {};
INSTANTIATE_TEST_SUITE_P(Axes, EmulatorOn,
                         testing::Combine(testing::Values(0, 1),
                                          testing::Values(std::optional<Eigen::Index>(),
                                                          std::optional<Eigen::Index>(1))));

TEST_P(EmulatorOn, GradientEqualsCentralDifferences) {
  const auto [axes, sides] = GetParam();
  const Emulator emulator(examples_of(/*cubic=*/true), kAxes[axes], sides);
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

/// Of more coordinates than have all products of three.
TEST(Emulator, OfManyCoordinatesHasCubesAndTheirGradient) {
  constexpr Eigen::Index kMany = 11, kExamples = 400;
  const auto residual = [](const Eigen::VectorXd& u) { return u[0] + 0.1 * u[10] * u[10] * u[10]; };
  Rng rng(3);
  Eigen::MatrixXd places(kMany, kExamples), residuals(1, kExamples);
  for (Eigen::Index i = 0; i < kExamples; ++i) {
    places.col(i) = rng.normals(kMany);
    residuals(0, i) = residual(places.col(i));
  }
  const Emulator emulator({places, residuals.transpose() * residuals});
  EXPECT_FALSE(emulator.is_cubic());
  for (int i = 0; i < 10; ++i) {
    constexpr double kStep = 1e-5;
    const Eigen::VectorXd u = rng.normals(kMany);
    const Evaluation here = emulator.evaluate({u, {}});
    EXPECT_NEAR(here.log_density, -(u.squaredNorm() + std::pow(residual(u), 2)) / 2, 0.05);
    for (const Eigen::Index k : {0, 10}) {
      const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(kMany, k);
      const double rise =
          emulator.evaluate({u + step, {}}).log_density - emulator.evaluate({u - step, {}}).log_density;
      EXPECT_NEAR(here.gradient[k], rise / (2 * kStep), 1e-4 * (1 + std::abs(here.gradient[k])));
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
  Emulator emulator(examples_of(/*cubic=*/true), kAxes[1], /*sides=*/2), read;
  Archive written;
  written(emulator);
  Archive archive(written.take_bytes());
  archive(read);
  archive.expect_end();
  const Position position{Eigen::VectorXd::Constant(kDimension, 0.4), {}};
  EXPECT_EQ(read.evaluate(position).log_density, emulator.evaluate(position).log_density);
  EXPECT_EQ(read.sides(), 2);
  EXPECT_TRUE(read.is_of(kDimension));
  EXPECT_FALSE(read.is_of(kDimension + 1));
  EXPECT_FALSE(Emulator().is_of(kDimension));
}

TEST(Emulator, FollowsGoodMatchesWhereItCannotFollowAll) {
  // r = |u_0 - 1| has a kink that no polynomial has; half of the examples lie beyond it and are poor matches.
  constexpr int kExamples = 400;
  Rng rng(11);
  Eigen::MatrixXd places(1, kExamples), residuals(1, kExamples);
  for (int i = 0; i < kExamples; ++i) {
    const double u = places(0, i) = 2 * rng.normal();
    residuals(0, i) = u < 1 ? 0.5 * u : 0.5 + 20 * (u - 1);
  }
  const Emulator emulator({places, residuals.transpose() * residuals});
  for (const double u : {-1.0, -0.5, 0.0, 0.5}) {
    const Eigen::VectorXd at = Eigen::VectorXd::Constant(1, u);
    EXPECT_NEAR(emulator.evaluate({at, {}}).log_density, -u * u / 2 - 0.125 * u * u, 2.5) << u;
  }
}

TEST(Emulator, FarBeyondItsExamplesRisesByALogarithmAndHasTheGradientOfThat) {
  const Emulator emulator(examples_of(/*cubic=*/true));
  const auto misfit = [&](double t) {
    const Eigen::VectorXd u = Eigen::VectorXd::Constant(kDimension, t);
    return -emulator.evaluate({u, {}}).log_density - u.squaredNorm() / 2;
  };
  const double far = misfit(20), further = misfit(40);
  // A sextic at most: twice as far is 64 times the polynomials' misfit.
  EXPECT_GT(further, far);
  EXPECT_LT(further - far, kDimension * std::log(65.0));
  constexpr double kStep = 1e-4;
  const Eigen::VectorXd u = Eigen::VectorXd::Constant(kDimension, 20);
  const double slope = (misfit(20 + kStep) - misfit(20 - kStep)) / (2 * kStep);
  EXPECT_NEAR(-(emulator.evaluate({u, {}}).gradient + u).sum(), slope, 1e-4 * std::abs(slope));
}

TEST(KnownResiduals, HaveTheProductsOfAllThatWereAddedHoweverTheyCame) {
  Rng rng(12);
  const Eigen::Index counts[] = {3, 1, 300};
  Eigen::MatrixXd places(kDimension, 304);
  Eigen::MatrixXf residuals(5, 304);
  for (auto column : places.colwise()) column = rng.normals(kDimension);
  for (auto column : residuals.colwise()) column = rng.normals(5).cast<float>();
  KnownResiduals known;
  Eigen::Index first = 0;
  for (const Eigen::Index count : counts) {
    known.add(places.middleCols(first, count), residuals.middleCols(first, count), /*threads=*/3);
    first += count;
  }
  const Eigen::MatrixXd exact = residuals.cast<double>().transpose() * residuals.cast<double>();
  EXPECT_LT((known.all().products - exact).norm(), 1e-12 * exact.norm());
  EXPECT_EQ(known.all().places, places);
  const EmulatorExamples best = known.worth_learning(2);
  EXPECT_EQ(best.energies()[0], known.all().energies().minCoeff()) << "best first";
  EXPECT_EQ(best.products(0, 0), 2 * best.energies()[0] - best.places.col(0).squaredNorm());
}

TEST(InformedDensity, GivesTheOtherCoordinatesTheirPriorAndLeavesLevelsAlone) {
  const Emulator emulator(examples_of(/*cubic=*/true));
  const FunctionDensity whole(5, [](const Position&) { return Evaluation{}; });
  const std::vector<Eigen::Index> informed{4, 0, 2};
  const InformedDensity density(emulator, informed, whole);
  Eigen::VectorXd u(5);
  u << 0.3, -1.2, 0.8, 2, -0.4;
  const Evaluation of_known = emulator.evaluate({u(informed), {}}), of_all = density.evaluate({u, {}});
  EXPECT_NEAR(of_all.log_density, of_known.log_density - (1.2 * 1.2 + 2 * 2) / 2, 1e-12);
  EXPECT_EQ(Eigen::VectorXd(of_all.gradient(informed)), of_known.gradient);
  EXPECT_EQ(of_all.gradient[1], 1.2);
  EXPECT_EQ(of_all.gradient[3], -2);
}

class EmulatedPosterior : public testing::Test {
 protected:
  static EmulateSettings usual() {
    return {.threads = 2, .enter_thread = [] { at::set_num_threads(1); }};
  }

  Posterior posterior_ = with_free("bump", {"light", "albedo_r", "rough"});
  Position mode_{Eigen::VectorXd::Zero(3), {}};
  std::vector<ChainState> starts_{{mode_, posterior_.value(mode_)}};
  Metric laplace_{laplace_covariance(posterior_, mode_)};
};

TEST_F(EmulatedPosterior, IsLearntFromAFewHundredEvaluationsUntilItsProposalsAreTaken) {
  const Emulation made = emulate(posterior_, starts_, laplace_, usual());
  ASSERT_TRUE(made.emulator) << made.taken;
  EXPECT_GE(made.taken, usual().good);
  EXPECT_LE(made.known.count(), 600);
  EXPECT_EQ(emulate(posterior_, starts_, laplace_, usual()).emulator->evaluate(mode_).log_density,
            made.emulator->evaluate(mode_).log_density)
      << "whatever the threads do";
}

class EmulatedAgain : public EmulatedPosterior {
 protected:
  Eigen::MatrixXd spread(double sds, int count) {
    Eigen::MatrixXd places(3, count);
    for (auto place : places.colwise()) place = sds * laplace_.colour(rng_.normals(3));
    return places;
  }

  /// Nats, at places of the posterior.
  double most_off(const Emulator& emulator) {
    double off = 0;
    for (const auto place : others_.colwise())
      off = std::max(off, std::abs(emulator.evaluate({place, {}}).log_density -
                                   posterior_.value({place, {}}).log_density));
    return off;
  }

  Emulator again(const Eigen::MatrixXd& places, const KnownResiduals& known) const {
    return emulate_about(posterior_, places, known, starts_.front(), laplace_, usual());
  }

  Rng rng_{4};
  Eigen::MatrixXd others_ = spread(1, 40);
};

TEST_F(EmulatedAgain, IsExactWhereItsOwnDrawsLeadBesideWhereChainsCameTo) {
  const Eigen::MatrixXd came_to = spread(0.05, 80);
  EXPECT_LT(most_off(again(came_to, {})), 0.3);
  KnownResiduals known;
  const Eigen::VectorXd observed = posterior_.in_errors(posterior_.photo_summary());
  for (const auto place : came_to.colwise())
    known.add(place, (posterior_.predicted({place, {}}) - observed).cast<float>());
  EXPECT_GT(most_off(Emulator(known.all())), 1) << "from these places alone";
}

TEST_F(EmulatedAgain, StillKnowsWhatWasKnownBefore) {
  const Emulation before = emulate(posterior_, starts_, laplace_, usual());
  ASSERT_TRUE(before.emulator);
  EXPECT_LT(most_off(again(spread(1, 1), before.known)), 0.3);
  // What nobody could find out: perfect matches where there are none.
  const Eigen::VectorXd far = laplace_.colour(Eigen::Vector3d(2.5, 0, 0));
  KnownResiduals dreamt;
  dreamt.add(spread(0.2, 400).colwise() + far, Eigen::MatrixXf::Zero(posterior_.photo_summary().size(), 400));
  const auto misfit_there = [&](const KnownResiduals& known) {
    return -again(spread(1, 80), known).evaluate({far, {}}).log_density - far.squaredNorm() / 2;
  };
  EXPECT_LT(misfit_there(dreamt), 0.5 * misfit_there({}));
}

TEST_F(EmulatedPosterior, IsRefusedWhereTooFewOfItsProposalsAreTaken) {
  EmulateSettings strict = usual();
  strict.good = strict.poor = 1.01;
  strict.most = 150;
  const Emulation made = emulate(posterior_, starts_, laplace_, strict);
  EXPECT_FALSE(made.emulator);
  EXPECT_LT(made.taken, 1.01);
  EXPECT_LE(made.known.count(), 150);
}

TEST_F(EmulatedPosterior, IsToldFromOneThatHasAnotherModeByWhatASearchFoundThere) {
  const Emulation made = emulate(posterior_, starts_, laplace_, usual());
  ASSERT_TRUE(made.emulator);
  const ChainState mode{mode_, posterior_.evaluate(mode_)};
  const auto at = [&](const Eigen::VectorXd& u) { return ChainState{{u, {}}, posterior_.evaluate({u, {}})}; };
  const ChainState near = at(laplace_.colour(Eigen::VectorXd::Constant(3, 0.5)));
  EXPECT_FALSE(misses_one(*made.emulator, posterior_.informed(), posterior_, mode,
                          {near, at(Eigen::VectorXd::Constant(3, 2))}));
  ChainState other = at(Eigen::VectorXd::Constant(3, 2));
  other.evaluation.log_density = mode.evaluation.log_density - 1;
  EXPECT_TRUE(misses_one(*made.emulator, posterior_.informed(), posterior_, mode, {near, other}));
}

TEST_F(EmulatedPosterior, DrawsOfItsKernelAreThoseOfHmcAtATenthOfTheRenders) {
  const Emulation made = emulate(posterior_, starts_, laplace_, usual());
  ASSERT_TRUE(made.emulator);
  SampleSettings settings;
  settings.warmup = 300;
  settings.draws = 1500;
  settings.threads = 2;
  settings.noise_repeats = 0;
  settings.enter_thread = [] { at::set_num_threads(1); };
  const auto start = [&](Rng&) { return mode_; };
  const auto kernel = make_emulated_kernel(*made.emulator, posterior_.informed(), posterior_, 1.5);
  const Sample emulated = sample(posterior_, *kernel, settings, start, laplace_);
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

TEST(EmulatedPlaces, DrawsAreThoseOfHmcWithRefreshMovesWhatTheEmulatorDoesNotKnowIncluded) {
  // Places of its maps and their choices are proposed by nothing but their prior.
  const Posterior posterior = with_free("leather", {"light", "rough", "scale", "shift_x", "shift_y"});
  ASSERT_TRUE(has_jagged(posterior));
  ASSERT_TRUE(can_emulate(posterior));
  ASSERT_EQ(std::ssize(posterior.informed()), 3) << "places are not informed";
  const Position mode{Eigen::VectorXd::Zero(5), Eigen::VectorXi::Zero(2)};
  const Metric laplace(laplace_covariance(posterior, mode));
  const auto enter = [] { at::set_num_threads(1); };
  const Emulation made = emulate(posterior, {{mode, posterior.value(mode)}}, laplace,
                                 {.most = 500, .threads = 2, .enter_thread = enter});
  ASSERT_TRUE(made.emulator) << made.taken;
  SampleSettings settings;
  settings.warmup = 300;
  settings.draws = 3000;
  settings.threads = 2;
  settings.noise_repeats = 0;
  settings.enter_thread = enter;
  const auto start = [&](Rng&) { return mode; };
  const auto kernel = make_emulated_kernel(*made.emulator, posterior.informed(), posterior, 1.5);
  const Sample emulated = sample(posterior, *kernel, settings, start, laplace);
  settings.seed = 2;
  const Sample plain =
      sample(posterior, *make_kernel("hmc", posterior, 0.8, usual_refresh(true)), settings, start, laplace);
  const auto agree = [](const Eigen::MatrixXd& x, const Eigen::MatrixXd& y, const std::string& of) {
    EXPECT_LT(split_rhat(x), 1.03) << of;
    EXPECT_NEAR(x.mean(), y.mean(), 4 * std::hypot(mcse_mean(x), mcse_mean(y))) << of;
    EXPECT_NEAR(standard_deviation(x), standard_deviation(y), 4 * std::hypot(mcse_sd(x), mcse_sd(y))) << of;
  };
  for (std::size_t i = 0; i < 5; ++i)
    agree(emulated.coordinates[i], plain.coordinates[i], "coordinate " + std::to_string(i));
  for (std::size_t i = 0; i < 2; ++i)
    agree(emulated.levels[i], plain.levels[i], "level " + std::to_string(i));
}

TEST(CanEmulate, AllMaterialsOfWhichMoreThanPlacesIsFree) {
  for (const char* material : {"bump", "metal", "translucent", "leather", "flake"})
    EXPECT_TRUE(can_emulate(with_free(material, {"light"}))) << material;
  EXPECT_FALSE(can_emulate(with_free("leather", {"shift_x", "shift_y"})));
}

}  // namespace
}  // namespace patina
