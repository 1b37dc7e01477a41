#include "engine/diagnostics/running_convergence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/diagnostics/convergence.h"
#include "tests/diagnostics/series.h"

// The figures that cost little against those that are exact.

namespace patina {
namespace {

RunningConvergence running(const Eigen::MatrixXd& draws) {
  RunningConvergence convergence;
  for (Eigen::Index t = 0; t < draws.rows(); ++t)
    for (Eigen::Index k = 0; k < draws.cols(); ++k) convergence.add(static_cast<int>(k), draws(t, k));
  return convergence;
}

/// What the header promises.
void expect_agreement(const ConvergenceFigures& cheap, const Eigen::MatrixXd& draws,
                      const std::string& what) {
  const double excess = split_rhat(draws) - 1;
  EXPECT_NEAR(cheap.rhat - 1, excess, 0.002 + 0.03 * std::abs(excess)) << what;
  EXPECT_NEAR(cheap.bulk_ess / bulk_ess(draws), 1, 0.2) << what;
  EXPECT_NEAR(cheap.tail_ess / tail_ess(draws), 1, 0.2) << what;
  EXPECT_NEAR(cheap.mean_ess / mean_ess(draws), 1, 0.2) << what;
  EXPECT_NEAR(cheap.mean, draws.mean(), 1e-12 * (1 + std::abs(draws.mean()))) << what;
  EXPECT_NEAR(cheap.sd, std::sqrt((draws.array() - draws.mean()).square().sum() / (draws.size() - 1.0)),
              1e-12 * (1 + std::abs(draws.mean())))
      << what;
}

TEST(RunningConvergence, agrees_with_the_exact_figures_and_the_closed_form_on_autoregressions) {
  for (const double r : {-0.5, 0.0, 0.5, 0.9, 0.99}) {
    const Eigen::MatrixXd draws = ar1(60000, 4, r, 21);
    const ConvergenceFigures cheap = running(draws).figures();
    expect_agreement(cheap, draws, "correlation " + std::to_string(r));
    // What is left of an ESS that grew tenfold is its own: the sample's, not the method's.
    const double expected = static_cast<double>(draws.size()) * (1 - r) / (1 + r);
    EXPECT_NEAR(cheap.mean_ess / expected, 1, 0.25) << r;
  }
}

TEST(RunningConvergence, agrees_at_every_length) {
  const Eigen::MatrixXd draws = ar1(20000, 4, 0.7, 22);
  for (const Eigen::Index length : {100, 511, 513, 1000, 5000, 20000}) {
    const Eigen::MatrixXd some = draws.topRows(length);
    expect_agreement(running(some).figures(), some, std::to_string(length) + " draws");
  }
}

TEST(RunningConvergence, agrees_on_skewed_draws_with_repeats_as_rejections_leave) {
  Eigen::MatrixXd draws = ar1(30000, 4, 0.8, 23).array().cube().exp().min(1e6);
  for (Eigen::Index t = 1; t < draws.rows(); ++t)
    for (Eigen::Index k = 0; k < 4; ++k)
      if ((7 * t + 3 * k) % 5 < 2) draws(t, k) = draws(t - 1, k);
  const ConvergenceFigures cheap = running(draws).figures();
  EXPECT_NEAR(cheap.rhat, split_rhat(draws), 0.002);
  EXPECT_NEAR(cheap.bulk_ess / bulk_ess(draws), 1, 0.2);
  EXPECT_NEAR(cheap.tail_ess / tail_ess(draws), 1, 0.2);
}

TEST(RunningConvergence, sees_chains_that_have_not_mixed) {
  const Eigen::MatrixXd draws = ar1(20000, 4, 0.5, 24);
  Eigen::MatrixXd shifted = draws, wider = draws, drifting = draws, stuck = 1e-3 * draws;
  shifted.col(0).array() += 1;
  wider.col(0) *= 3;
  drifting.col(2) += Eigen::VectorXd::LinSpaced(20000, 0, 2);
  for (Eigen::Index k = 0; k < 4; ++k) stuck.col(k).array() += static_cast<double>(k);
  for (const auto& [what, unmixed] :
       {std::pair("shifted", shifted), {"wider", wider}, {"drifting", drifting}, {"stuck", stuck}}) {
    const ConvergenceFigures cheap = running(unmixed).figures();
    EXPECT_GT(cheap.rhat, 1.03) << what;
    expect_agreement(cheap, unmixed, what);
  }
}

TEST(RunningConvergence, sees_a_place_that_chains_reach_late_far_from_where_they_were) {
  Eigen::MatrixXd draws = ar1(20000, 4, 0.3, 25);
  draws.bottomRows(4000) *= 0.01;
  draws.bottomRows(4000).array() += 1000;
  draws.bottomRows(4000).col(1).array() += 0.05;  // which levels of before could not tell apart
  expect_agreement(running(draws).figures(), draws, "all chains went away together");
  const ConvergenceFigures after = running(draws.bottomRows(4000)).figures();
  EXPECT_GT(after.rhat, 1.5);
}

TEST(RunningConvergence, treats_few_values_as_they_are) {
  const Eigen::MatrixXd levels = (2 * ar1(3000, 4, 0.6, 26)).array().round();
  expect_agreement(running(levels).figures(), levels, "whole numbers");
  Eigen::MatrixXd late = Eigen::MatrixXd::Zero(3000, 4);
  late.bottomRows(50).setOnes();
  EXPECT_NEAR(running(late).figures().rhat, split_rhat(late), 0.01);
}

TEST(RunningConvergence, of_chains_of_different_length_is_that_of_what_all_have) {
  const Eigen::MatrixXd draws = ar1(8000, 3, 0.5, 27);
  RunningConvergence convergence = running(draws.topRows(4096));
  for (Eigen::Index t = 4096; t < 8000; ++t) convergence.add(1, draws(t, 1));
  expect_agreement({draws.topRows(4096).mean(),
                    std::sqrt((draws.topRows(4096).array() - draws.topRows(4096).mean()).square().sum() /
                              (3 * 4096 - 1.0)),
                    convergence.figures().rhat,
                    convergence.figures().bulk_ess,
                    convergence.figures().tail_ess,
                    convergence.figures().mean_ess,
                    {}},
                   draws.topRows(4096), "the first 4096");
  EXPECT_NEAR(convergence.figures().chain_means[1], draws.col(1).mean(), 1e-12);
}

TEST(RunningConvergence, is_undefined_for_few_or_not_finite_draws_and_of_a_constant_has_as_many_as_draws) {
  EXPECT_TRUE(std::isnan(RunningConvergence().figures().rhat));
  EXPECT_TRUE(std::isnan(running(ar1(3, 4, 0, 28)).figures().rhat));
  EXPECT_TRUE(std::isfinite(running(ar1(4, 4, 0, 28)).figures().rhat));
  Eigen::MatrixXd broken = ar1(100, 4, 0, 29);
  broken(50, 2) = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(std::isnan(running(broken).figures().rhat));
  EXPECT_TRUE(std::isnan(running(broken).figures().bulk_ess));
  const ConvergenceFigures constant = running(Eigen::MatrixXd::Constant(100, 4, 0.1)).figures();
  EXPECT_TRUE(std::isnan(constant.rhat));
  EXPECT_EQ(constant.bulk_ess, 400);
  EXPECT_EQ(constant.sd, 0);
}

TEST(RunningConvergence, of_a_single_batch_series_would_be_fooled_where_it_is_not) {
  // Negative control: independent draws in the order of their values within batches have the same histograms,
  // and so must have the same figures, though their exact ESS is another.
  Eigen::MatrixXd draws = ar1(65536, 2, 0, 30);
  Eigen::MatrixXd sorted = draws;
  for (auto chain : sorted.colwise())
    for (Eigen::Index from = 0; from < chain.size(); from += 64) std::sort(&chain[from], &chain[from] + 64);
  EXPECT_NEAR(running(sorted).figures().bulk_ess / running(draws).figures().bulk_ess, 1, 0.02);
  EXPECT_NEAR(running(sorted).figures().bulk_ess / static_cast<double>(draws.size()), 1, 0.2);
}

TEST(RunningConvergence, holds_less_than_the_draws_themselves) {
  RunningConvergence convergence = running(ar1(250000, 4, 0.5, 31));
  EXPECT_LT(convergence.bytes(), 1000000 * sizeof(double) * 3 / 4);
}

}  // namespace
}  // namespace patina
