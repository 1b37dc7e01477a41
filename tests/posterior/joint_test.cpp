#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/diagnostics/convergence.h"
#include "engine/material/renderer.h"
#include "engine/posterior/posterior.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/prior_draw.h"
#include "engine/sampling/rng.h"
#include "tests/sampling/statistics.h"

// Prior, render, error model and kernels at once, on renders of 16 pixels whose regional means are seen with
// the very errors that the posterior assumes: (u, s) with u from the prior and s from the sampling
// distribution is then an exact draw of the joint law, and u one of the posterior given s.

namespace patina {
namespace {

constexpr double kFamilyWiseAlpha = 1e-5;

Posterior small_posterior(const std::string& material) {
  PosteriorSettings settings;
  settings.material = material;
  settings.resolution = 16;
  settings.summary = "means";
  settings.mean_sigma = 0.2;  // wide enough that a few transitions cross the posterior
  const Renderer renderer(material, 1, Capture{});
  return Posterior(settings, renderer.render(prior_location(renderer.table()), 16));
}

/// A summary as it would be seen. @param sd  of its errors; 1 is what the posterior assumes
Eigen::VectorXd observation(const Posterior& posterior, const Position& position, double sd, Rng& rng) {
  const Eigen::VectorXd mean = posterior.predicted(position);
  return mean + sd * rng.normals(mean.size());
}

KernelSettings settings_for(const Posterior& posterior) {
  return {0.3, std::make_shared<const Metric>(Metric::identity(posterior.dimension()))};
}

/// What is followed: every continuous coordinate, then the log density.
Eigen::VectorXd quantities(const ChainState& state) {
  Eigen::VectorXd all(state.position.continuous.size() + 1);
  all << state.position.continuous, state.evaluation.log_density;
  return all;
}

/// The rank of an exact draw among the states that lead to and from it, of every quantity, as a number in
/// (0, 1). All kernels are reversible, so that steps back are steps; with the draw at a random place of the
/// sequence its rank is uniform however slowly the chain moves (Gandy & Scott 2021, "Unit testing for MCMC
/// and other Monte Carlo methods", section 3.2).
Eigen::VectorXd ranks(const Kernel& kernel, const Posterior& posterior, const Position& truth, Rng& rng) {
  constexpr int kStates = 20, kTransitions = 2;
  const KernelSettings settings = settings_for(posterior);
  const ChainState exact{truth, posterior.evaluate(truth)};
  const Eigen::VectorXd here = quantities(exact);
  // States that equal the exact one, as rejections leave them, are ranked by lot.
  const double lot = rng.uniform();
  Eigen::VectorXd below = Eigen::VectorXd::Zero(here.size());
  const int before = rng.below(kStates);
  for (const int length : {before, kStates - 1 - before}) {
    ChainState state = exact;
    for (int i = 0; i < length; ++i) {
      for (int k = 0; k < kTransitions; ++k) kernel.step(posterior, settings, state, rng);
      const Eigen::VectorXd there = quantities(state);
      for (Eigen::Index q = 0; q < here.size(); ++q)
        below[q] += there[q] < here[q] || (there[q] == here[q] && rng.uniform() < lot);
    }
  }
  for (double& rank : below) rank = (rank + rng.uniform()) / kStates;
  return below;
}

/// The largest Kolmogorov distance of the ranks from uniform, in units of its bound: above 1 they are not.
double worst_rank_distance(const std::string& material, double error_sd) {
  constexpr int kReplicates = 300;
  const Posterior posterior = small_posterior(material);
  const auto kernel = make_kernel("hmc", posterior, 0.8, 0.5);
  std::vector<std::vector<double>> all(static_cast<std::size_t>(posterior.dimension()) + 1);
  Rng rng(11);
  for (int i = 0; i < kReplicates; ++i) {
    const Position truth = prior_draw(posterior, rng);
    const Posterior given = posterior.given(observation(posterior, truth, error_sd, rng));
    const Eigen::VectorXd rank = ranks(*kernel, given, truth, rng);
    for (std::size_t q = 0; q < all.size(); ++q) all[q].push_back(rank[static_cast<Eigen::Index>(q)]);
  }
  const double bound = testing_statistics::dkw_bound(kReplicates, kFamilyWiseAlpha / double(all.size()));
  double worst = 0;
  for (const std::vector<double>& sample : all)
    worst = std::max(worst, testing_statistics::ks_distance(sample, [](double p) { return p; }) / bound);
  return worst;
}

TEST(SimulationBasedCalibration, RanksOfEveryParameterAndOfTheLogDensityAreUniform) {
  for (const char* material : {"bump", "leather"}) EXPECT_LT(worst_rank_distance(material, 1), 1) << material;
}

TEST(SimulationBasedCalibration, SeesErrorsTwiceThoseThatThePosteriorAssumes) {
  EXPECT_GT(worst_rank_distance("bump", 2), 1);
}

/// Draws of every coordinate from the chain that draws in turn an observation given the parameters and
/// parameters given the observation: of the prior, whatever else is right (Geweke 2004, "Getting it right").
std::vector<Eigen::MatrixXd> successive_conditionals(const std::string& material, double error_sd) {
  constexpr int kRounds = 2500, kChains = 2;
  const Posterior posterior = small_posterior(material);
  const auto kernel = make_kernel("hmc", posterior, 0.8, 0.5);
  const KernelSettings settings = settings_for(posterior);
  std::vector<Eigen::MatrixXd> draws(static_cast<std::size_t>(posterior.dimension()),
                                     Eigen::MatrixXd(kRounds, kChains));
  for (int chain = 0; chain < kChains; ++chain) {
    Rng rng(12, static_cast<std::uint64_t>(chain));
    Position position = prior_draw(posterior, rng);
    for (int i = 0; i < kRounds; ++i) {
      const Posterior given = posterior.given(observation(posterior, position, error_sd, rng));
      ChainState state{position, given.evaluate(position)};
      kernel->step(given, settings, state, rng);
      position = state.position;
      for (std::size_t k = 0; k < draws.size(); ++k)
        draws[k](i, chain) = position.continuous[static_cast<Eigen::Index>(k)];
    }
  }
  return draws;
}

/// The largest z score of means and mean squares against those of N(0, 1).
double worst_z(const std::vector<Eigen::MatrixXd>& draws) {
  double worst = 0;
  for (const Eigen::MatrixXd& x : draws) {
    const Eigen::MatrixXd squares = x.array().square();
    worst = std::max(
        {worst, std::abs(x.mean()) / mcse_mean(x), std::abs(squares.mean() - 1) / mcse_mean(squares)});
  }
  return worst;
}

TEST(GewekesJointTest, FindsThePriorAgain) { EXPECT_LT(worst_z(successive_conditionals("bump", 1)), 4.5); }

TEST(GewekesJointTest, SeesErrorsTwiceThoseThatThePosteriorAssumes) {
  EXPECT_GT(worst_z(successive_conditionals("bump", 2)), 4.5);
}

}  // namespace
}  // namespace patina
