#include "engine/sampling/mirror_images.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/sampling/function_density.h"
#include "engine/sampling/kernels.h"
#include "tests/sampling/targets.h"

namespace patina {
namespace {

constexpr double kSd = 0.2;

double normal_about(double u, double centre) { return -(u - centre) * (u - centre) / (2 * kSd * kSd); }

/// Basins about u_0 = -1.5 and, as deep, about 1.2, where u_1 is another; and all else normal about 0.8.
FunctionDensity two_basins() {
  return FunctionDensity(4, [](const Position& p) {
    const Eigen::VectorXd& u = p.continuous;
    const double below = normal_about(u[0], -1.5) + normal_about(u[1], 0.8);
    const double above = normal_about(u[0], 1.2) + normal_about(u[1], 0.7);
    const double more = std::max(below, above);
    return Evaluation{more + std::log(std::exp(below - more) + std::exp(above - more)) +
                          normal_about(u[2], 2.5) - u[3] * u[3] / 8,
                      Eigen::VectorXd::Zero(4)};
  });
}

ChainState good_place(const LogDensity& target) {
  const Position place{Eigen::Vector4d(-1.5, 0.8, 2.5, 1), {}};
  return {place, target.evaluate(place)};
}

const Eigen::Vector4d kSds(kSd, kSd, kSd, 2);

TEST(MirrorImages, are_of_another_basin_and_neither_hopelessly_deep_nor_of_the_same_one) {
  const FunctionDensity target = two_basins();
  const ChainState place = good_place(target);
  const auto images = mirror_images(target, place, kSds, {.coordinates = {0, 1, 2, 3}, .threads = 2});
  ASSERT_EQ(images.size(), 2u) << "u_2's is 312 nats below, u_3's one sd away";
  EXPECT_EQ(images[0].position.continuous, Eigen::Vector4d(1.5, 0.8, 2.5, 1));
  EXPECT_EQ(images[1].position.continuous, Eigen::Vector4d(-1.5, -0.8, 2.5, 1)) << "32 nats below";
  EXPECT_EQ(images[0].evaluation.log_density, target.evaluate(images[0].position).log_density);
  EXPECT_GT(images[0].evaluation.log_density, images[1].evaluation.log_density);
}

TEST(MirrorImages, are_made_along_the_coordinates_that_are_named_alone) {
  const FunctionDensity target = two_basins();
  EXPECT_TRUE(mirror_images(target, good_place(target), kSds, {.coordinates = {2, 3}}).empty());
  EXPECT_TRUE(mirror_images(target, good_place(target), kSds, {}).empty());
}

TEST(MirrorMove, crosses_a_valley_as_often_as_the_other_side_is_as_likely) {
  const FunctionDensity target(1, [](const Position& p) {
    const double u = p.continuous[0], size = std::abs(u);
    return Evaluation{-50 * (size - 2) * (size - 2) + (u > 0 ? std::log(2) : 0), Eigen::VectorXd::Zero(1)};
  });
  const auto move = make_mirror_move(0);
  Rng rng(4);
  ChainState state = state_at(target, {Eigen::VectorXd::Constant(1, -2), {}});
  int above = 0;
  constexpr int kMoves = 30000;
  for (int i = 0; i < kMoves; ++i) {
    move->step(target, {}, state, rng);
    above += state.position.continuous[0] > 0;
    EXPECT_EQ(std::abs(state.position.continuous[0]), 2);
  }
  EXPECT_NEAR(above / double(kMoves), 2.0 / 3, 0.02);
}

}  // namespace
}  // namespace patina
