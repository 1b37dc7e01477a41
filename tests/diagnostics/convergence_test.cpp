#include "engine/diagnostics/convergence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "engine/diagnostics/effective_sample_size.h"
#include "engine/diagnostics/ranks.h"
#include "tests/diagnostics/series.h"

namespace patina {
namespace {

TEST(MeanAutocovariance, by_fourier_transform_is_the_sum_of_products) {
  const Eigen::MatrixXd draws = ar1(37, 3, 0.6, 1);
  const Eigen::VectorXd fast = mean_autocovariance(draws);
  const Eigen::MatrixXd centred = draws.rowwise() - draws.colwise().mean();
  ASSERT_EQ(fast.size(), 37);
  for (Eigen::Index lag = 0; lag < 37; ++lag) {
    const double sum = (centred.topRows(37 - lag).array() * centred.bottomRows(37 - lag).array()).sum();
    EXPECT_NEAR(fast[lag], sum / (37 * 3), 1e-14);
  }
}

TEST(EffectiveSampleSize, of_a_first_order_autoregression_is_the_closed_form) {
  for (const double r : {-0.3, 0.0, 0.5, 0.9}) {
    const Eigen::MatrixXd draws = ar1(25000, 4, r, 2);
    const double expected = static_cast<double>(draws.size()) * (1 - r) / (1 + r);
    EXPECT_NEAR(mean_ess(draws) / expected, 1, 0.1) << "correlation " << r;
    EXPECT_NEAR(bulk_ess(draws) / expected, 1, 0.1) << "correlation " << r;
  }
}

TEST(EffectiveSampleSize, is_small_where_every_chain_stays_where_it_is) {
  Eigen::MatrixXd draws = 1e-3 * ar1(1000, 4, 0, 3);
  for (Eigen::Index k = 0; k < 4; ++k) draws.col(k).array() += static_cast<double>(k);
  EXPECT_LT(bulk_ess(draws), 8);
  EXPECT_GT(split_rhat(draws), 2);
}

TEST(SplitRhat, is_near_one_for_one_distribution_and_far_for_two) {
  Eigen::MatrixXd draws = ar1(1000, 4, 0.3, 4);
  EXPECT_LT(split_rhat(draws), 1.01);
  Eigen::MatrixXd shifted = draws, wider = draws;
  shifted.col(0).array() += 1;
  wider.col(0) *= 3;
  EXPECT_GT(split_rhat(shifted), 1.05);
  EXPECT_GT(split_rhat(wider), 1.05) << "folding is what sees a difference of scale";
}

TEST(SplitRhat, sees_a_single_chain_that_drifts) {
  Eigen::MatrixXd draws = ar1(1000, 1, 0, 5);
  EXPECT_LT(split_rhat(draws), 1.01);
  draws.col(0) += Eigen::VectorXd::LinSpaced(1000, 0, 2);
  EXPECT_GT(split_rhat(draws), 1.05);
}

TEST(RankNormalised, diagnostics_do_not_see_a_monotone_map) {
  const Eigen::MatrixXd draws = ar1(400, 4, 0.5, 6);
  const Eigen::MatrixXd mapped = draws.array().exp();
  EXPECT_DOUBLE_EQ(bulk_ess(draws), bulk_ess(mapped));
  EXPECT_DOUBLE_EQ(tail_ess(draws), tail_ess(mapped));
  EXPECT_NE(mean_ess(draws), mean_ess(mapped));
}

TEST(Diagnostics, do_not_depend_on_the_order_of_chains_and_scale_as_they_should) {
  const Eigen::MatrixXd draws = ar1(301, 3, 0.5, 7);
  const Eigen::MatrixXd reversed = draws.rowwise().reverse();
  const Eigen::MatrixXd scaled = -4 * draws;
  for (auto* diagnostic : {split_rhat, bulk_ess, tail_ess, mean_ess, mcse_mean, mcse_sd})
    EXPECT_NEAR(diagnostic(draws), diagnostic(reversed), 1e-10 * diagnostic(draws));
  EXPECT_NEAR(mcse_mean(scaled), 4 * mcse_mean(draws), 1e-10);
  EXPECT_NEAR(mcse_sd(scaled), 4 * mcse_sd(draws), 1e-10);
  EXPECT_NEAR(mcse_quantile(scaled, 0.25), 4 * mcse_quantile(draws, 0.75), 0.1);
  EXPECT_NEAR(bulk_ess(scaled), bulk_ess(draws), 1e-8);
}

/// An error estimate against the errors themselves, over many repetitions of the same experiment.
TEST(Mcse, is_the_spread_of_the_estimate_over_repeated_runs) {
  constexpr int repeats = 300;
  Eigen::ArrayXd means(repeats), sds(repeats), medians(repeats);
  double mean_error = 0, sd_error = 0, median_error = 0;
  for (int i = 0; i < repeats; ++i) {
    const Eigen::MatrixXd draws = ar1(250, 4, 0.5, 100 + i);
    means[i] = draws.mean();
    sds[i] = std::sqrt((draws.array() - draws.mean()).square().mean());
    medians[i] = quantile(draws, 0.5);
    mean_error += mcse_mean(draws) / repeats;
    sd_error += mcse_sd(draws) / repeats;
    median_error += mcse_quantile(draws, 0.5) / repeats;
  }
  const auto spread = [](const Eigen::ArrayXd& x) { return std::sqrt((x - x.mean()).square().mean()); };
  EXPECT_NEAR(mean_error / spread(means), 1, 0.2);
  EXPECT_NEAR(sd_error / spread(sds), 1, 0.2);
  EXPECT_NEAR(median_error / spread(medians), 1, 0.2);
}

TEST(Quantile, is_linear_between_order_statistics) {
  Eigen::MatrixXd draws(5, 1);
  draws << 50, 10, 40, 20, 30;
  EXPECT_DOUBLE_EQ(quantile(draws, 0), 10);
  EXPECT_DOUBLE_EQ(quantile(draws, 1), 50);
  EXPECT_DOUBLE_EQ(quantile(draws, 0.5), 30);
  EXPECT_DOUBLE_EQ(quantile(draws, 0.3), 22);
  EXPECT_TRUE(std::isnan(quantile(draws, 1.5)));
}

TEST(RankNormalise, gives_ties_their_average_rank) {
  Eigen::MatrixXd draws(2, 2);
  draws << 1, 2, 3, 2;
  const Eigen::MatrixXd scores = rank_normalise(draws);
  EXPECT_NEAR(scores(0, 1), 0, 1e-15);  // ranks 2 and 3 of four: in the middle
  EXPECT_EQ(scores(0, 1), scores(1, 1));
  EXPECT_NEAR(scores(0, 0), -scores(1, 0), 1e-14);
}

TEST(Ebfmi, of_independent_energies_is_two_and_of_a_random_walk_near_nought) {
  const Eigen::VectorXd independent = ar1(20000, 1, 0, 8).col(0);
  EXPECT_NEAR(ebfmi(independent), 2, 0.05);
  EXPECT_LT(ebfmi(ar1(20000, 1, 0.99, 9).col(0)), 0.05);
}

TEST(Diagnostics, are_undefined_for_few_or_not_finite_draws) {
  const Eigen::MatrixXd few = ar1(3, 4, 0, 10);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Eigen::MatrixXd broken = ar1(100, 4, 0, 11);
    broken(50, 2) = bad;
    for (auto* diagnostic : {split_rhat, bulk_ess, tail_ess, mean_ess, mcse_mean, mcse_sd}) {
      EXPECT_TRUE(std::isnan(diagnostic(few)));
      EXPECT_TRUE(std::isnan(diagnostic(broken)));
    }
    EXPECT_TRUE(std::isnan(mcse_quantile(broken, 0.5)));
    EXPECT_TRUE(std::isnan(quantile(broken, 0.5)));
    EXPECT_TRUE(std::isnan(ebfmi(broken.col(2))));
  }
}

TEST(Diagnostics, of_a_constant_have_no_rhat_and_as_many_effective_draws_as_draws) {
  const Eigen::MatrixXd constant = Eigen::MatrixXd::Constant(101, 4, 0.1);
  EXPECT_TRUE(std::isnan(split_rhat(constant)));
  for (auto* diagnostic : {bulk_ess, tail_ess, mean_ess}) EXPECT_EQ(diagnostic(constant), 404);
  EXPECT_EQ(mcse_mean(constant), 0);
  EXPECT_EQ(mcse_sd(constant), 0);
  EXPECT_EQ(mcse_quantile(constant, 0.5), 0);
}

TEST(Diagnostics, cope_with_a_quantity_of_two_values) {
  const Eigen::MatrixXd coin = (ar1(500, 4, 0.3, 12).array() > 0).cast<double>();
  EXPECT_LT(split_rhat(coin), 1.02);
  EXPECT_GT(bulk_ess(coin), 500);
}

TEST(Diagnostics, are_defined_from_four_draws_on) {
  for (const Eigen::Index n : {4, 5, 6, 9, 12}) {
    const Eigen::MatrixXd draws = ar1(n, 2, 0, 13);
    for (auto* diagnostic : {split_rhat, bulk_ess, tail_ess, mean_ess, mcse_mean, mcse_sd})
      EXPECT_TRUE(std::isfinite(diagnostic(draws))) << n << " draws";
  }
}

}  // namespace
}  // namespace patina
