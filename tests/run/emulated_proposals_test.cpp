#include "engine/run/emulated_proposals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "engine/posterior/emulated_moves.h"
#include "engine/run/chain_start.h"
#include "engine/sampling/function_density.h"
#include "engine/sampling/sample.h"

namespace patina {
namespace {

std::vector<std::pair<int, std::size_t>> moves(const std::vector<std::vector<double>>& log_densities) {
  std::vector<std::pair<int, std::size_t>> result;
  for (const ChainIteration& move : moves_of_warmup(log_densities))
    result.emplace_back(move.chain, move.iteration);
  return result;
}

TEST(MovesOfWarmup, AreWhereChainsCameToOnceEachAndSideBySideInTime) {
  using Moves = std::vector<std::pair<int, std::size_t>>;
  EXPECT_EQ(moves({{-3, -3, -2, -3}, {-5, -4, -4, -4}}), (Moves{{0, 0}, {1, 0}, {1, 1}, {0, 2}, {0, 3}}));
}

TEST(MovesOfWarmup, OfChainsThatWereStoppedAreOfWhatThereIs) {
  EXPECT_TRUE(moves({{}, {}}).empty());
  EXPECT_EQ(moves({{}, {-1, -2}}).size(), 2u);
}

double distance(const ChainState& a, const ChainState& b) {
  return (a.position.continuous - b.position.continuous).norm();
}

/// Of each but the first `kept` ones to the nearest of those before it.
std::vector<double> distances_to_those_before(const std::vector<ChainState>& states, std::size_t kept) {
  std::vector<double> result;
  for (std::size_t i = kept; i < states.size(); ++i) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < i; ++j) nearest = std::min(nearest, distance(states[i], states[j]));
    result.push_back(nearest);
  }
  return result;
}

TEST(FollowedTogether, AreTheBestByTheTargetAndWhatNoDeepValleyParts) {
  // Between the first two of three basins the target falls by a few nats, on the way to the third by 200.
  const FunctionDensity target(1, [](const Position& p) {
    const double u = p.continuous[0];
    const double near = std::max(-12.5 * u * u, -2 - 12.5 * (u - 1.5) * (u - 1.5));
    return Evaluation{std::max(near, 1 - 78 * (u - 8) * (u - 8)), Eigen::VectorXd::Zero(1)};
  });
  const auto end = [](double u, double said) {
    return ChainState{{Eigen::VectorXd::Constant(1, u), {}}, {said, {}}};
  };
  const auto places = [&](std::vector<ChainState> ends) {
    std::vector<double> result;
    for (const ChainState& kept : followed_together(target, std::move(ends))) {
      EXPECT_EQ(kept.evaluation.log_density, target.evaluate(kept.position).log_density);
      result.push_back(kept.position.continuous[0]);
    }
    return result;
  };
  EXPECT_EQ(places({end(1.5, 0), end(0, -9)}), (std::vector<double>{0, 1.5}));
  EXPECT_EQ(places({end(0, 0), end(1.5, 0), end(8, 0)}), (std::vector<double>{8}));
}

TEST(EmulatorStarts, AreTheBasinsAndThenThoseThatLieFurthestApart) {
  const FunctionDensity target(3, [](const Position&) {  // flat: no start is climbed from
    return Evaluation{0, Eigen::VectorXd::Zero(3)};
  });
  const ChainState mode{{Eigen::VectorXd::Zero(3), {}}, {0, {}}};
  const Metric laplace = Metric::identity(3);
  const Position aside{Eigen::Vector3d(1, 1, 1), {}};
  const std::vector<ChainState> basins{mode, {aside, target.evaluate(aside)}};
  const std::vector<ChainState> starts = emulator_starts(target, target, mode, basins, laplace, 5, 2, {});
  ASSERT_EQ(starts.size(), static_cast<std::size_t>(kEmulatorWalkers));
  EXPECT_EQ(distance(starts[0], basins[0]), 0);
  EXPECT_EQ(distance(starts[1], basins[1]), 0);
  EXPECT_TRUE(std::ranges::is_sorted(distances_to_those_before(starts, 2), std::greater<>()));

  std::vector<ChainState> as_they_come = basins;
  for (std::uint64_t i = 2; i < starts.size(); ++i) {
    Rng rng(5, i);
    as_they_come.push_back(overdispersed_start(target, mode, laplace, rng));
  }
  EXPECT_FALSE(std::ranges::is_sorted(distances_to_those_before(as_they_come, 2), std::greater<>()));
  const double apart = distances_to_those_before(starts, 2).back();
  EXPECT_GT(apart, std::ranges::min(distances_to_those_before(as_they_come, 2)));
}

TEST(EmulatorStarts, FoundOnARoughLikenessLieHighEnoughOnTheTarget) {
  constexpr double kSd = 0.1;
  const FunctionDensity target(3, [&](const Position& position) {
    const Eigen::VectorXd scaled = position.continuous / kSd;
    return Evaluation{-scaled.squaredNorm() / 2, -scaled / kSd};
  });
  const FunctionDensity rough(3, [](const Position& position) {  // beside it, and wider
    const Eigen::VectorXd off = position.continuous - Eigen::Vector3d(0.5, 0, 0);
    return Evaluation{-off.squaredNorm(), -2 * off};
  });
  const ChainState mode{{Eigen::VectorXd::Zero(3), {}}, {0, {}}};
  const Metric laplace(kSd * kSd * Eigen::Matrix3d::Identity());
  constexpr double kThreeSdsOfChiSquare = 3 + 3 * 2.45;
  for (const ChainState& start : emulator_starts(rough, target, mode, {mode}, laplace, 5, 2, {})) {
    EXPECT_EQ(start.evaluation.log_density, target.evaluate(start.position).log_density);
    EXPECT_GT(start.evaluation.log_density, -kThreeSdsOfChiSquare);
  }
  const Evaluation of_the_likeness = target.evaluate({Eigen::Vector3d(0.5, 0.5, 0), {}});
  EXPECT_LT(of_the_likeness.log_density, -kThreeSdsOfChiSquare) << "the likeness alone would do";
}

TEST(MetricInUse, OfEmulatedProposalsIsOneOfTheirOwnCoordinatesByWhichTheyTakeFewerSteps) {
  // A ridge, narrow and a little bent: x_1 is x_0^2 / 5, give or take 0.15.
  const auto off_the_ridge = [](const Eigen::Vector2d& x) { return (x[1] - 0.2 * x[0] * x[0]) / 0.15; };
  Rng rng(2);
  Eigen::MatrixXd places(2, 60), residuals(1, 60);
  for (Eigen::Index i = 0; i < places.cols(); ++i) {
    places.col(i) = rng.normals(2);
    residuals(0, i) = off_the_ridge(places.col(i));
  }
  const Emulator emulator({places, residuals.transpose() * residuals});
  const FunctionDensity target(2, [&](const Position& at) { return emulator.evaluate(at); });
  const auto kernel = make_emulated_kernel(emulator, {0, 1}, target, 1.5);
  const auto drawn_by = [&](MetricKind metric) {
    return sample(target, *kernel, {.warmup = 500, .draws = 200, .seed = 3, .metric = metric});
  };
  const Sample straightened = drawn_by(MetricKind::curved),
               own = drawn_by(metric_in_use(MetricKind::curved, /*emulated=*/true));
  ASSERT_TRUE(straightened.frozen.straightening) << "the ridge is not bent enough for this test to tell";
  EXPECT_FALSE(own.frozen.straightening);
  EXPECT_LT(1.5 * static_cast<double>(own.evaluations), static_cast<double>(straightened.evaluations));
}

TEST(MetricInUse, IsWhatWasAskedForWhereNothingIsEmulatedOrNothingStraightened) {
  EXPECT_EQ(metric_in_use(MetricKind::curved, false), MetricKind::curved);
  EXPECT_EQ(metric_in_use(MetricKind::diagonal, true), MetricKind::diagonal);
}

}  // namespace
}  // namespace patina
