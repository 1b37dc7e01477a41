#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "engine/posterior/emulated_moves.h"
#include "engine/posterior/emulator.h"
#include "engine/posterior/informed_density.h"
#include "engine/sampling/function_density.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/sample.h"

namespace patina {
namespace {

/// Basins about u_0 = -1.5 and 1.5, a deep valley between, where u_1 goes with u_2 the other way; of the
/// other coordinates nothing is known.
EmulatorExamples examples_on_both_sides(std::uint64_t seed) {
  constexpr int kExamples = 400;
  Rng rng(seed);
  Eigen::MatrixXd places(6, kExamples), residuals(2, kExamples);
  for (Eigen::Index i = 0; i < kExamples; ++i) {
    const double side = i % 2 == 0 ? -1 : 1;
    places.col(i) = rng.normals(6);
    places.col(i).head(2) << 1.5 * side + 0.3 * rng.normal(), 0.3 * rng.normal();
    const double u = places(0, i), v = places(1, i), w = places(2, i);
    residuals.col(i) << 6 * (std::abs(u) - 1.5), 8 * (v - 0.15 * std::tanh(u / 0.7) * w);
  }
  return {places, residuals.transpose() * residuals};
}

TEST(Emulator, WithSidesFollowsWhatHoldsOnOneOfThem) {
  const EmulatorExamples examples = examples_on_both_sides(6), others = examples_on_both_sides(7);
  const auto off = [&](const Emulator& emulator) {
    std::vector<double> off;
    for (Eigen::Index i = 0; i < others.count(); ++i)
      if (others.products(i, i) / 2 < 6)  // nats, of those that it is to follow
        off.push_back(
            std::abs(emulator.evaluate({others.places.col(i), {}}).log_density + others.energies()[i]));
    return std::accumulate(off.begin(), off.end(), 0.0) / static_cast<double>(off.size());
  };
  const double with = off(Emulator(examples, {}, /*sides=*/0)), without = off(Emulator(examples));
  EXPECT_LT(with, 0.1);
  EXPECT_GT(without, 3 * with);
}

TEST(EmulatedProposals, GoFromOneSideToTheOtherWhereAnEmulatorHasSides) {
  const Emulator emulator(examples_on_both_sides(6), {}, /*sides=*/0);
  const FunctionDensity flat(6, [](const Position&) { return Evaluation{}; });
  const std::vector<Eigen::Index> all{0, 1, 2, 3, 4, 5};
  const EmulatedProposals proposals(emulator, all, flat);
  const InformedDensity density(emulator, all, flat);
  Eigen::VectorXd start = Eigen::VectorXd::Zero(6), variances = Eigen::VectorXd::Ones(6);
  start[0] = -1.5;
  variances.head(2) << 0.03, 0.02;
  const Metric metric(Eigen::MatrixXd(variances.asDiagonal()));
  const auto above = [&](const Kernel& kernel) {
    const SampleSettings settings{.chains = 2, .warmup = 100, .draws = 400, .noise_repeats = 0};
    const auto begin = [&](Rng&) { return Position{start, {}}; };
    const Sample sample = patina::sample(density, kernel, settings, begin, metric);
    return (sample.coordinates[0].array() > 0).cast<double>().mean();
  };
  EXPECT_NEAR(above(*proposals.until_taken(1.5)), 0.5, 0.15);
  EXPECT_EQ(above(*make_rejection(make_hmc(1.5), density, 25)), 0) << "no trajectory crosses the valley";
}

}  // namespace
}  // namespace patina
