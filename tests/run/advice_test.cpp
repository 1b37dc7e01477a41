#include "engine/run/advice.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

#include "engine/error.h"
#include "engine/material/off_values.h"
#include "engine/material/registry.h"
#include "engine/posterior/prior_transform.h"

namespace patina {
namespace {

/// Names with priors N(0, 1) that nothing cuts, so that values are sampling coordinates.
ParameterTable table_of(const std::vector<std::string>& names) {
  ParameterTable table;
  for (const std::string& name : names) table.continuous.push_back({name, "", "", {0, 1, -50, 50}});
  return table;
}

/// Four chains of independent normal draws.
std::vector<Draw> normal_draws(const Eigen::VectorXd& mean, const Eigen::MatrixXd& covariance) {
  std::mt19937_64 generator(9);
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd factor = covariance.llt().matrixL();
  std::vector<Draw> draws;
  for (int i = 0; i < 8000; ++i) {
    Eigen::VectorXd x(mean.size());
    for (double& each : x) each = normal(generator);
    x = mean + factor * x;
    Draw draw;
    draw.chain = i % 4;
    draw.iteration = i / 4;
    draw.values.continuous = {x.begin(), x.end()};
    draws.push_back(draw);
  }
  return draws;
}

TEST(Advice, tells_what_is_pinned_down_what_is_not_and_what_trades_against_what) {
  Eigen::Matrix4d c = Eigen::Vector4d(0.01, 1, 0.2, 0.2).asDiagonal();
  c(2, 3) = c(3, 2) = -0.195;
  const auto advice =
      advise(table_of({"sharp", "loose", "light", "albedo"}), normal_draws(Eigen::Vector4d::Zero(), c), {});
  ASSERT_EQ(advice.size(), 4u);
  EXPECT_TRUE(advice[0].identified);
  EXPECT_EQ(advice[0].sentence, "");
  EXPECT_FALSE(advice[1].identified);
  EXPECT_NE(advice[1].sentence.find("does not pin down loose"), std::string::npos);
  EXPECT_EQ(advice[2].redundant_with, "albedo");
  EXPECT_EQ(advice[3].redundant_with, "light");
  EXPECT_NEAR(advice[3].correlation, -0.975, 0.01);
  EXPECT_EQ(frozen_by(advice).size(), 1u);
  EXPECT_TRUE(frozen_by(advice).contains("loose"));
}

// The draws are of a normal posterior, so that what is left when something is held is known: the others'
// posterior given that it is held, which must be the one that they had.
TEST(Advice, what_it_holds_leaves_the_posterior_of_the_rest_and_what_is_needed_it_does_not_hold) {
  for (const double correlation : {0.02, 0.6}) {
    Eigen::Matrix3d c = Eigen::Vector3d(0.95, 0.04, 0.09).asDiagonal();
    c(0, 1) = c(1, 0) = correlation * std::sqrt(c(0, 0) * c(1, 1));
    const auto advice =
        advise(table_of({"loose", "a", "b"}), normal_draws(Eigen::Vector3d(0.1, 1, -1), c), {});
    const auto frozen = frozen_by(advice);
    if (correlation > 0.5) {
      EXPECT_TRUE(frozen.empty()) << "a's posterior would narrow by a fifth";
      EXPECT_NE(advice[0].sentence.find("leave it"), std::string::npos);
      continue;
    }
    ASSERT_TRUE(frozen.contains("loose"));
    const double moved = c(1, 0) / c(0, 0) * (frozen.at("loose") - 0.1) / std::sqrt(c(1, 1));
    EXPECT_LT(std::abs(moved), kMostShift);
    EXPECT_LT(1 - std::sqrt(1 - correlation * correlation), kMostNarrowing);
  }
}

TEST(Advice, several_that_could_be_held_alone_are_not_held_together_where_that_changes_the_rest) {
  // Each of five explains a fifteenth of y's variance: one narrows it by 3.4 %, two by 6.9 %.
  Eigen::MatrixXd c = Eigen::MatrixXd::Identity(6, 6);
  for (int i = 0; i < 5; ++i) c(i, 5) = c(5, i) = 0.05;
  c(5, 5) = 0.0375;
  const auto frozen = frozen_by(
      advise(table_of({"p", "q", "r", "s", "t", "y"}), normal_draws(Eigen::VectorXd::Zero(6), c), {}));
  EXPECT_EQ(frozen.size(), 1u);
}

/// A component's weight in [0, 1] with a flat prior, and posterior density n (1 - w)^(n - 1): n at "off".
std::vector<Draw> component_draws(double n) {
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> uniform;
  std::vector<Draw> draws;
  for (int i = 0; i < 20000; ++i) {
    Draw draw;
    draw.chain = i % 4;
    draw.iteration = i / 4;
    draw.values.continuous = {1 - std::pow(uniform(generator), 1 / n)};
    draws.push_back(draw);
  }
  return draws;
}

ParameterTable component_table() {
  ParameterTable table;
  table.continuous = {{"glow", "", "", {0.5, 100, 0, 1}}};
  return table;
}

TEST(Advice, a_component_is_not_needed_as_far_as_its_absence_has_become_likelier) {
  const auto five = advise(component_table(), component_draws(5), {{"glow", 0}});
  ASSERT_TRUE(five[0].off);
  EXPECT_LT(std::abs(five[0].off->ratio - 5), 4 * five[0].off->error + 0.1);
  EXPECT_EQ(five[0].freeze_at, 0);
  EXPECT_NE(five[0].sentence.find("does not need glow"), std::string::npos);

  const auto two = advise(component_table(), component_draws(2), {{"glow", 0}});
  EXPECT_LT(std::abs(two[0].off->ratio - 2), 4 * two[0].off->error);
  EXPECT_EQ(two[0].freeze_at, std::nullopt) << "twice as likely is no evidence";

  const auto present = advise(component_table(), component_draws(5), {{"glow", 1}});
  EXPECT_LT(present[0].off->ratio, 0.1);
  EXPECT_EQ(present[0].freeze_at, std::nullopt);
}

TEST(Advice, of_too_few_draws_or_held_parameters_there_is_none) {
  std::vector<Draw> draws = component_draws(5);
  draws.resize(20);
  EXPECT_TRUE(advise(component_table(), draws, {}).empty());
  draws = component_draws(5);
  for (Draw& draw : draws) draw.values.continuous = {0.25};
  EXPECT_TRUE(advise(component_table(), draws, {{"glow", 0}}).empty());
}

TEST(OffValues, lie_where_the_prior_is_not_negligible) {
  int count = 0;
  for (const std::string& material : material_names()) {
    const ParameterTable table = material_table(material);
    for (const auto& [name, value] : off_values(material)) {
      const TruncatedNormal& prior = table.continuous[*table.find_continuous(name)].prior;
      EXPECT_LE(std::abs(value - prior.mean), 2 * prior.sd) << material << " " << name;
      EXPECT_TRUE(value == prior.low || value == prior.high) << "an end: nothing less than absent";
      ++count;
    }
  }
  EXPECT_GE(count, 7);
}

}  // namespace
}  // namespace patina
