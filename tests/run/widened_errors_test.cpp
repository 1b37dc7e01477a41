#include "engine/run/widened_errors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/sampling/function_density.h"

namespace patina {
namespace {

constexpr double kSd = 0.1;

/// Normal about u_0 = -1.5, or about 1.1 with another u_1, whichever is denser; normal about u_2 = 0.6.
FunctionDensity two_basins() {
  return FunctionDensity(3, [](const Position& p) {
    const Eigen::Vector3d centre =
        p.continuous[0] < 0 ? Eigen::Vector3d(-1.5, 0.2, 0.6) : Eigen::Vector3d(1.1, -0.4, 0.6);
    const Eigen::Vector3d off = p.continuous - centre, variances(kSd * kSd, kSd * kSd, 0.04);
    return Evaluation{-off.cwiseAbs2().cwiseQuotient(variances).sum() / 2, -off.cwiseQuotient(variances)};
  });
}

TEST(ClimbedImages, EndInBasinsOnTheOtherSideAndAreNoneWhereTheyClimbBack) {
  const FunctionDensity target = two_basins();
  const Position mode{Eigen::Vector3d(-1.5, 0.2, 0.6), {}};
  const Metric laplace(Eigen::Matrix3d(Eigen::Vector3d(kSd * kSd, kSd * kSd, 0.04).asDiagonal()));
  const ChainState best{mode, target.evaluate(mode)};
  const auto images = climbed_images(target, best, laplace, {0, 1, 2});
  ASSERT_EQ(images.size(), 1u) << "along u_2 an image is 18 nats deep and climbs back";
  EXPECT_LT((images[0].position.continuous - Eigen::Vector3d(1.1, -0.4, 0.6)).norm(), 1e-3);
  EXPECT_TRUE(climbed_images(target, best, laplace, {1, 2}).empty());
}

}  // namespace
}  // namespace patina
