#include "engine/diagnostics/modes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

namespace patina {
namespace {

using Eigen::MatrixXd;
using Eigen::MatrixXi;

const MatrixXi kNoChoices(0, 0);

MatrixXd gaussian(Eigen::Index count, Eigen::Index dimension, std::mt19937& rng) {
  std::normal_distribution<double> normal;
  return MatrixXd::NullaryExpr(count, dimension, [&] { return normal(rng); });
}

TEST(Modes, AGaussianCloudIsOneWhateverItsDimensionAndScales) {
  std::mt19937 rng(1);
  for (const Eigen::Index dimension : {1, 2, 8, 25}) {
    for (int trial = 0; trial < 30; ++trial) {
      const Eigen::Index count = 200 + 400 * (trial % 5);
      MatrixXd points = gaussian(count, dimension, rng);
      for (Eigen::Index i = 0; i < dimension; ++i)
        points.col(i) *= std::pow(10.0, static_cast<double>(i % 7) - 3);
      const auto modes = find_modes(points, kNoChoices);
      ASSERT_EQ(modes.size(), 1u) << dimension << " dimensions, trial " << trial;
      ASSERT_EQ(modes[0].members.size(), static_cast<std::size_t>(count));
    }
  }
}

TEST(Modes, RidgesBentOrNotTailsAndUniformBoxesAreOneCloud) {
  std::mt19937 rng(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 30; ++trial) {
    MatrixXd banana(800, 2), bow(800, 2), tail(800, 2), box(800, 3);
    for (Eigen::Index i = 0; i < 800; ++i) {
      const double a = normal(rng), turn = M_PI * uniform(rng);
      banana.row(i) << a, a * a + 0.2 * normal(rng);
      bow.row(i) << std::cos(turn) + 0.05 * normal(rng), std::sin(turn) + 0.05 * normal(rng);
      tail.row(i) << std::exp(normal(rng)), normal(rng);
      box.row(i) << uniform(rng), uniform(rng), uniform(rng);
    }
    EXPECT_EQ(find_modes(banana, kNoChoices).size(), 1u) << trial;
    EXPECT_EQ(find_modes(bow, kNoChoices).size(), 1u) << trial;
    EXPECT_EQ(find_modes(tail, kNoChoices).size(), 1u) << trial;
    EXPECT_EQ(find_modes(box, kNoChoices).size(), 1u) << trial;
  }
}

/// A mixture of Gaussians; @return which of them each row is from
std::vector<int> mixture(const MatrixXd& centres, const std::vector<double>& shares, MatrixXd& points,
                         std::mt19937& rng) {
  points = gaussian(points.rows(), centres.cols(), rng);
  std::discrete_distribution<int> which(shares.begin(), shares.end());
  std::vector<int> origins;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    origins.push_back(which(rng));
    points.row(i) += centres.row(origins.back());
  }
  return origins;
}

void expect_found(const std::vector<Mode>& modes, const std::vector<int>& origins, std::size_t count) {
  ASSERT_EQ(modes.size(), count);
  std::set<int> seen;
  std::size_t wrong = 0;
  for (const Mode& mode : modes) {
    std::vector<std::size_t> from(count);
    for (const Eigen::Index row : mode.members)
      ++from[static_cast<std::size_t>(origins[static_cast<std::size_t>(row)])];
    const auto most = std::ranges::max_element(from) - from.begin();
    seen.insert(static_cast<int>(most));
    wrong += mode.members.size() - from[static_cast<std::size_t>(most)];
  }
  EXPECT_EQ(seen.size(), count) << "every cloud is found once";
  EXPECT_LT(static_cast<double>(wrong), 0.02 * static_cast<double>(origins.size()));
}

TEST(Modes, CloudsSixDeviationsApartAreToldApartAlongAnyDirectionOfManyDimensions) {
  std::mt19937 rng(3);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Index dimension = 1 + 3 * (trial % 8);
    MatrixXd centres(2, dimension), points(1000, dimension);
    const Eigen::VectorXd direction = gaussian(1, dimension, rng).row(0).normalized();
    centres.row(0).setZero();
    centres.row(1) = 6 * direction;
    const auto origins = mixture(centres, {0.7, 0.3}, points, rng);
    expect_found(find_modes(points, kNoChoices), origins, 2);
  }
}

TEST(Modes, ThreeCloudsAndUnequalOnesAreFoundLargestFirst) {
  std::mt19937 rng(4);
  MatrixXd centres(3, 4), points(2000, 4);
  centres << 0, 0, 0, 0, 7, 0, 0, 0, 0, 7, 7, 0;
  const auto origins = mixture(centres, {0.1, 0.6, 0.3}, points, rng);
  const auto modes = find_modes(points, kNoChoices);
  expect_found(modes, origins, 3);
  EXPECT_NEAR(static_cast<double>(modes[0].members.size()) / 2000, 0.6, 0.04);
  EXPECT_NEAR(static_cast<double>(modes[2].members.size()) / 2000, 0.1, 0.03);
}

TEST(Modes, CloudsThatOverlapAreOne) {
  std::mt19937 rng(5);
  for (int trial = 0; trial < 20; ++trial) {
    MatrixXd centres(2, 3), points(1000, 3);
    centres << 0, 0, 0, 3, 0, 0;
    mixture(centres, {0.5, 0.5}, points, rng);
    EXPECT_EQ(find_modes(points, kNoChoices).size(), 1u) << trial;
  }
}

TEST(Modes, DiscreteChoicesPartWhatLiesInOnePlaceAndRareOnesAreNone) {
  std::mt19937 rng(6);
  const MatrixXd points = gaussian(1000, 3, rng);
  MatrixXi choices(1000, 2);
  for (int i = 0; i < 1000; ++i) choices.row(i) << (i % 4 == 0 ? 1 : 0), (i < 10 ? 1 : 0);
  const auto modes = find_modes(points, choices);
  ASSERT_EQ(modes.size(), 2u);
  for (const Mode& mode : modes) {
    for (const Eigen::Index row : mode.members) {
      EXPECT_EQ(choices(row, 0), choices(mode.members[0], 0));
      EXPECT_EQ(choices(row, 1), 0);
    }
  }
  EXPECT_EQ(modes[0].members.size() + modes[1].members.size(), 990u);
}

TEST(Modes, OfFewDrawsOrNoneAreNone) {
  std::mt19937 rng(7);
  EXPECT_TRUE(find_modes(MatrixXd(0, 3), MatrixXi(0, 1)).empty());
  EXPECT_TRUE(find_modes(gaussian(20, 3, rng), kNoChoices).empty());
}

TEST(Modes, OfDrawsThatAllCoincideAreOne) {
  EXPECT_EQ(find_modes(MatrixXd::Constant(100, 3, 0.5), kNoChoices).size(), 1u);
}

}  // namespace
}  // namespace patina
