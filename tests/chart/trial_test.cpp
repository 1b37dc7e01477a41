#include "engine/chart/trial.h"

#include <gtest/gtest.h>

#include "engine/chart/photo_problem.h"
#include "engine/run/emulated_proposals.h"
#include "tests/chart/gaussian_problem.h"

namespace patina {
namespace {

TEST(Trial, counts_every_evaluation_that_the_target_saw) {
  const GaussianProblem problem;
  const Trial trial = run_trial(problem, quick_setting(), {.seed = 3, .draws = 100, .threads = 2});
  EXPECT_EQ(trial.evaluations, problem.evaluations());
  EXPECT_GT(trial.search_evaluations, 0);
  EXPECT_GT(trial.warmup_evaluations, 0);
  EXPECT_LT(trial.search_evaluations + trial.warmup_evaluations, trial.evaluations);
  EXPECT_GT(trial.value_evaluations, 0) << "of refresh and discrete moves";
  EXPECT_LT(trial.value_evaluations, trial.evaluations);
}

TEST(Trial, from_one_seed_has_the_same_draws_and_counts_on_any_number_of_threads) {
  const GaussianProblem problem;
  const auto run = [&](std::uint64_t seed, int threads) {
    return run_trial(problem, quick_setting(), {.seed = seed, .draws = 60, .threads = threads});
  };
  const Trial one = run(5, 1), again = run(5, 3), other = run(6, 1);
  EXPECT_EQ(one.evaluations, again.evaluations);
  EXPECT_EQ(one.warmup_evaluations, again.warmup_evaluations);
  EXPECT_EQ(one.draws().continuous, again.draws().continuous);
  EXPECT_EQ(one.draws().discrete, again.draws().discrete);
  EXPECT_NE(one.draws().continuous, other.draws().continuous);
}

TEST(Trial, has_the_best_match_first_and_then_draws_in_order_of_time) {
  const GaussianProblem problem;
  const Trial trial = run_trial(problem, quick_setting(), {.seed = 3, .draws = 50});
  ASSERT_FALSE(trial.search.empty());
  ASSERT_EQ(trial.chains.size(), 4u);
  for (const TrialChain& chain : trial.chains) {
    ASSERT_EQ(chain.seconds.size(), 50u);
    EXPECT_TRUE(std::ranges::is_sorted(chain.seconds));
    EXPECT_LE(trial.search.back().seconds, chain.seconds.front());
    EXPECT_LE(chain.seconds.back(), trial.seconds);
  }
}

TEST(Trial, whose_time_is_over_before_it_begins_has_evaluated_nothing) {
  const GaussianProblem problem;
  const Trial trial = run_trial(problem, quick_setting(), {.seed = 3, .draws = 50, .seconds = 1e-9});
  EXPECT_EQ(trial.evaluations, 0);
  EXPECT_EQ(problem.evaluations(), 0);
  EXPECT_EQ(trial.draws().draws(), 0);
}

/// Learns its target by a hundred simulations.
class LearningProblem final : public ChartProblem {
 public:
  std::string description() const override { return known_.description(); }
  std::vector<std::string> names() const override { return known_.names(); }
  std::vector<std::unique_ptr<LogDensity>> targets(const ChartSetting& setting) const override {
    return known_.targets(setting);
  }
  Eigen::VectorXd values(const Position& position) const override { return position.continuous; }
  Learnt learn(const ChartSetting& setting, std::uint64_t,
               const std::function<void()>& simulated) const override {
    for (int i = 0; i < kSimulations; ++i) simulated();
    Learnt learnt{std::move(known_.targets(setting).back()), {}, {}};
    learnt.mode.position = {Eigen::Vector3d::Zero(), Eigen::VectorXi::Zero(1)};
    learnt.mode.evaluation = learnt.target->evaluate(learnt.mode.position);
    learnt.laplace = std::make_shared<const Metric>(Eigen::MatrixXd::Identity(3, 3) * 0.2);
    return learnt;
  }

  /// The biased target, by as many evaluations.
  std::optional<Averaged> average(const ChartSetting& setting, const std::vector<ChainState>& ends,
                                  std::uint64_t seed, const std::function<void()>& evaluated) const override {
    EXPECT_FALSE(ends.empty()) << "a search comes first";
    if (!follows_averages) return std::nullopt;
    ChartSetting biased = setting;
    biased.summary = "biased";
    Learnt learnt = learn(biased, seed, evaluated);
    auto kernel = known_.kernel(quick_setting(), *learnt.target);
    return Averaged{std::move(learnt), std::move(kernel)};
  }

  static constexpr int kSimulations = 100;
  bool follows_averages = true;

 private:
  GaussianProblem known_;
};

TEST(Trial, of_calibrated_errors_learns_its_target_in_place_of_a_search) {
  ChartSetting setting = quick_setting();
  setting.errors = "calibrated";
  const Trial trial = run_trial(LearningProblem(), setting, {.seed = 3, .draws = 1000, .threads = 2});
  EXPECT_EQ(trial.search_evaluations, LearningProblem::kSimulations);
  ASSERT_EQ(trial.draws().draws(), 1000);
  const GaussianProblem known;
  EXPECT_NEAR(trial.draws().continuous[0].mean(), known.true_mean(0), 0.25 * known.true_sd(0));
}

TEST(Trial, of_averaged_errors_draws_from_the_average_after_a_search_and_a_short_warm_up) {
  ChartSetting setting = quick_setting();
  setting.errors = "averaged";
  setting.warmup = 100'000;
  const Trial trial = run_trial(LearningProblem(), setting, {.seed = 3, .draws = 1000, .threads = 2});
  EXPECT_GT(trial.search_evaluations, 0);
  EXPECT_GT(trial.warmup_evaluations, LearningProblem::kSimulations);
  EXPECT_LT(trial.warmup_evaluations, 100'000);
  ASSERT_EQ(trial.draws().draws(), 1000);
  const GaussianProblem known;
  const double off = (trial.draws().continuous[1].mean() - known.true_mean(1)) / known.true_sd(1);
  EXPECT_NEAR(off, GaussianProblem::kBias, 0.2);
}

TEST(Trial, of_averaged_errors_draws_from_the_target_where_nothing_follows_its_averages) {
  ChartSetting setting = quick_setting();
  LearningProblem problem;
  problem.follows_averages = false;
  const QuantityDraws by_hand = run_trial(problem, setting, {.seed = 3, .draws = 300, .threads = 2}).draws();
  setting.errors = "averaged";
  const QuantityDraws fallen_back =
      run_trial(problem, setting, {.seed = 3, .draws = 300, .threads = 2}).draws();
  ASSERT_EQ(by_hand.draws(), 300);
  EXPECT_EQ(fallen_back.continuous, by_hand.continuous);
}

TEST(Trial, of_a_photo_draws_from_its_average_over_irregularities) {
  RunSettings settings;
  settings.material = "plaster";
  settings.summary = "means";
  settings.resolution = 32;
  const PhotoProblem photo(settings, photo_of_prior_draw(settings, 1, 2), "a draw from the prior");
  ASSERT_TRUE(photo.target().can_average);
  const ChartSetting setting = default_setting(photo.target());
  ASSERT_EQ(setting.errors, "averaged");
  const auto means_of_seed = [&](std::uint64_t seed) {
    const Trial trial = run_trial(photo, setting, {.seed = seed, .draws = 300, .threads = 2});
    EXPECT_EQ(trial.draws().draws(), 300);
    EXPECT_GT(trial.warmup_evaluations, 4 * kAveragedWarmup + 200) << "those that it is learnt from, too";
    return trial.draws();
  };
  const QuantityDraws one = means_of_seed(3), other = means_of_seed(4);
  for (std::size_t i = 0; i < one.continuous.size(); ++i) {
    const Eigen::ArrayXXd &a = one.continuous[i], &b = other.continuous[i];
    const double sd = std::sqrt((a - a.mean()).square().mean());
    EXPECT_NEAR(a.mean(), b.mean(), 0.5 * sd) << photo.names()[i] << ", learnt from other renders";
  }
}

TEST(Trial, draws_from_the_target_where_a_posterior_beside_it_proposes) {
  ChartSetting setting = quick_setting();
  setting.proposals = 16;
  const GaussianProblem problem;
  const Trial trial = run_trial(problem, setting, {.seed = 3, .draws = 4000, .threads = 2});
  EXPECT_EQ(trial.evaluations, problem.evaluations());
  // What proposes is off by 0.2 sds; 16,000 draws in all know a mean to 0.02.
  for (Eigen::Index i = 0; i < 3; ++i)
    EXPECT_NEAR(trial.draws().continuous[static_cast<std::size_t>(i)].mean(), problem.true_mean(i),
                0.1 * problem.true_sd(i))
        << i;
  setting.proposals = 0;
  setting.resolution = 16;
  const Trial beside = run_trial(problem, setting, {.seed = 3, .draws = 4000, .threads = 2});
  EXPECT_GT(beside.draws().continuous[1].mean(), problem.true_mean(1) + 0.1 * problem.true_sd(1))
      << "drawn from what proposes, the means are off";
}

/// A posterior's, which counts what is learnt from its warm-up.
class EmulatedProblem final : public ChartProblem {
 public:
  std::string description() const override { return photo_.description(); }
  std::vector<std::string> names() const override { return photo_.names(); }
  std::vector<std::unique_ptr<LogDensity>> targets(const ChartSetting& setting) const override {
    return photo_.targets(setting);
  }
  Eigen::VectorXd values(const Position& position) const override { return photo_.values(position); }
  void use_threads(int count) const override { photo_.use_threads(count); }
  std::vector<Eigen::Index> informed() const override { return photo_.informed(); }
  Emulation emulate(const ChartSetting& setting, const std::vector<ChainState>& starts, const Metric& laplace,
                    std::uint64_t seed, const std::function<void()>& evaluated) const override {
    return photo_.emulate(setting, starts, laplace, seed, evaluated);
  }
  Emulator emulate_about(const ChartSetting& setting, const Eigen::MatrixXd& places,
                         const KnownResiduals& known, const ChainState& mode, const Metric& laplace,
                         std::uint64_t seed, const std::function<void()>& evaluated) const override {
    places_ += places.cols();
    known_ += known.count();
    return photo_.emulate_about(setting, places, known, mode, laplace, seed, evaluated);
  }

  Eigen::Index places() const { return places_; }
  Eigen::Index known() const { return known_; }

 private:
  static RunSettings settings() {
    RunSettings settings;
    settings.material = "bump";
    settings.summary = "means";
    settings.resolution = 32;
    return settings;
  }

  PhotoProblem photo_{settings(), photo_of_prior_draw(settings(), 1, 2), "a draw from the prior"};
  mutable Eigen::Index places_ = 0, known_ = 0;
};

TEST(Trial, of_emulated_proposals_learns_them_again_from_warm_up_as_a_run_does) {
  const EmulatedProblem problem;
  ChartSetting setting = default_setting({.can_emulate = true});
  setting.warmup = 60;
  const Trial trial = run_trial(problem, setting, {.seed = 3, .draws = 40, .threads = 2});
  ASSERT_EQ(trial.draws().draws(), 40);
  EXPECT_GT(problem.places(), 60) << "of four chains of 60";
  EXPECT_LE(problem.places(), 240);
  EXPECT_GT(problem.known(), 100) << "what was learnt before counts on";
}

TEST(Trial, whose_time_is_over_while_it_learns_has_no_draws) {
  ChartSetting setting = quick_setting();
  setting.errors = "calibrated";
  const Trial trial = run_trial(LearningProblem(), setting, {.seed = 3, .draws = 50, .seconds = 1e-9});
  EXPECT_EQ(trial.evaluations, 0);
  EXPECT_EQ(trial.draws().draws(), 0);
}

TEST(Trial, cuts_its_chains_to_the_shortest) {
  Trial trial;
  trial.chains.resize(2);
  for (int k = 0; k < 2; ++k)
    for (int i = 0; i < 3 + k; ++i) {
      trial.chains[k].seconds.push_back(i);
      trial.chains[k].values.push_back(Eigen::Vector2d(i, 10 * k));
      trial.chains[k].levels.push_back(Eigen::VectorXi::Constant(1, i % 2));
    }
  const QuantityDraws draws = trial.draws();
  ASSERT_EQ(draws.continuous.size(), 2u);
  EXPECT_EQ(draws.continuous[0], Eigen::Vector3d(0, 1, 2).replicate(1, 2));
  EXPECT_EQ(draws.continuous[1].col(1), Eigen::Vector3d::Constant(10));
  EXPECT_EQ(draws.discrete[0].col(1), Eigen::Vector3d(0, 1, 0));
}

}  // namespace
}  // namespace patina
