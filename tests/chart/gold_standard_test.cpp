#include "engine/chart/gold_standard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "engine/error.h"
#include "engine/io/temporary_folder.h"
#include "tests/chart/autoregression.h"
#include "tests/chart/gaussian_problem.h"

namespace patina {
namespace {

GoldPlan small_plan(int draws = 12000) {
  GoldPlan plan{gold_settings(default_setting()), {.seed = 100, .draws = draws}};
  for (ChartSetting& setting : plan.settings) setting.warmup = 300;
  return plan;
}

TEST(GoldStandard, of_a_gaussian_is_one_and_has_its_moments_within_its_own_errors) {
  const GaussianProblem problem;
  const GoldStandard gold(draw_gold(problem, small_plan()), problem.names());
  EXPECT_TRUE(gold.is_gold()) << gold.least_converged().name << " " << gold.least_converged().rhat;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const GoldQuantity& quantity = gold.continuous()[static_cast<std::size_t>(i)];
    EXPECT_EQ(quantity.draws.cols(), 8) << "chains of both kernels";
    EXPECT_NEAR(quantity.mean, problem.true_mean(i), 4 * quantity.mcse_mean) << quantity.name;
    EXPECT_NEAR(quantity.sd, problem.true_sd(i), 4 * quantity.mcse_sd) << quantity.name;
  }
  EXPECT_NEAR(gold.discrete()[0].mean, 0.7, 4 * gold.discrete()[0].mcse_mean);
}

TEST(GoldStandard, whose_kernels_disagree_is_none) {
  Rng rng(1);
  Eigen::MatrixXd draws = autoregressive_draws(2000, 8, 0.2, rng);
  EXPECT_TRUE(GoldStandard({{draws}, {}}, {"x"}).is_gold());
  draws.rightCols(4).array() += 0.5;
  const GoldStandard split({{draws}, {}}, {"x"});
  EXPECT_FALSE(split.is_gold());
  EXPECT_GT(split.least_converged().rhat, 1.02);
  EXPECT_FALSE(GoldStandard({{Eigen::MatrixXd::Constant(100, 8, 1.5)}, {}}, {"x"}).is_gold())
      << "never moved";
}

TEST(GoldStandard, is_read_back_to_the_bit_for_its_target_and_plan_and_for_no_other) {
  const TemporaryFolder folder;
  const GaussianProblem problem, other({0.2, 0.3, 0.5});
  const GoldPlan plan = small_plan(50), longer = small_plan(60);
  const std::vector<double> print = fingerprint(*target_of(problem));
  EXPECT_FALSE(read_gold(folder.path(), problem.names(), print, plan).has_value());
  const QuantityDraws draws = draw_gold(problem, plan);
  write_gold(folder.path(), draws, problem.names(), print, plan);
  const auto back = read_gold(folder.path(), problem.names(), print, plan);
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->continuous, draws.continuous);
  EXPECT_EQ(back->discrete, draws.discrete);
  EXPECT_FALSE(read_gold(folder.path(), problem.names(), print, longer).has_value());
  EXPECT_FALSE(read_gold(folder.path(), problem.names(), fingerprint(*target_of(other)), plan).has_value());
}

TEST(GoldStandard, that_is_damaged_is_refused) {
  const TemporaryFolder folder;
  const GaussianProblem problem;
  const GoldPlan plan = small_plan(50);
  const std::vector<double> print = fingerprint(*target_of(problem));
  write_gold(folder.path(), draw_gold(problem, plan), problem.names(), print, plan);
  std::ofstream(folder.path() / "gold.csv", std::ios::app) << "1,2\n";
  EXPECT_THROW(read_gold(folder.path(), problem.names(), print, plan), UserError);
}

TEST(GoldStandard, without_draws_is_refused_with_what_to_do) {
  GoldPlan plan = small_plan();
  plan.trial.seconds = 1e-9;
  try {
    draw_gold(GaussianProblem(), plan);
    FAIL();
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find("--gold-minutes"), std::string::npos);
  }
}

}  // namespace
}  // namespace patina
