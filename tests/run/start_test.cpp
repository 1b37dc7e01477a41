#include <cmath>

#include "engine/run/chain_start.h"
#include "engine/run/predicted_start.h"
#include "tests/run/run_fixture.h"

namespace patina {
namespace {

class StartTest : public RunTest {
 protected:
  /// The first draws of both chains of a run whose chains hardly move.
  std::vector<Draw> first_draws(const RunSettings& settings, const std::string& name) const {
    std::vector<Draw> first;
    for (Draw& draw : draws_to_the_end(*start_run(settings, photo(), folder_ / name)))
      if (draw.iteration == 0) first.push_back(std::move(draw));
    std::ranges::sort(first, {}, &Draw::chain);
    return first;
  }

  /// All moves are short random walks: a chain's first draw is its start, or one step from it.
  static RunSettings short_settings(const std::string& start) {
    RunSettings short_settings = settings();
    short_settings.start = start;
    short_settings.kernel = "mh";
    short_settings.refresh = 0;
    short_settings.warmup = 0;
    short_settings.draws = 1;
    return short_settings;
  }
};

TEST_F(StartTest, ChainsBeginWhereTheFileAndThePriorsMeansSay) {
  RunSettings asked = short_settings("values");
  const Renderer renderer("bump", 2, Capture{});
  const std::size_t rough = *renderer.table().find_continuous("rough");
  const TruncatedNormal& prior = renderer.table().continuous[rough].prior;
  asked.start_at["rough"] = prior.high - 0.01 * (prior.high - prior.low);
  const double near = 0.2 * (prior.high - prior.low);
  for (const Draw& draw : first_draws(asked, "values"))
    EXPECT_NEAR(draw.values.continuous[rough], asked.start_at["rough"], near);
  for (const Draw& draw : first_draws(short_settings("prior-mean"), "mean"))
    EXPECT_NEAR(draw.values.continuous[rough], prior.mean, near);
}

TEST_F(StartTest, PredictedStartsLieHigherThanThePriors) {
  const auto mean_lp = [&](const std::string& start) {
    double sum = 0;
    constexpr std::uint64_t kRuns = 3;
    for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
      RunSettings asked = short_settings(start);
      asked.seed = seed;
      for (const Draw& draw : first_draws(asked, start + std::to_string(seed)))
        sum += draw.lp / static_cast<double>(kRuns * static_cast<std::uint64_t>(asked.chains));
    }
    return sum;
  };
  EXPECT_GT(mean_lp("predict"), mean_lp("prior") + 10);
}

TEST_F(StartTest, AMaterialWithoutAPredictorIsRefusedInASentence) {
  EXPECT_NE(user_error([&] { prediction_for("felt", photo().image, Capture{}); }).find("--start"),
            std::string::npos);
}

TEST_F(StartTest, AStartThatCannotBeIsRefusedBeforeAnythingIsSearched) {
  RunSettings bad = settings();
  bad.start = "somewhere";
  EXPECT_NE(user_error([&] { start(bad); }).find("prior-mean"), std::string::npos);
  bad.start = "values";
  bad.start_at["rough"] = 1e9;
  EXPECT_NE(user_error([&] { start(bad); }), "");
  EXPECT_FALSE(std::filesystem::exists(directory()));
}

/// No density left of -1.5.
class HalfLine final : public LogDensity {
 public:
  Eigen::Index dimension() const override { return 1; }
  std::vector<int> discrete_levels() const override { return {4}; }
  Evaluation evaluate(const Position& p) const override {
    if (p.continuous[0] < -1.5) return {-INFINITY, Eigen::VectorXd::Zero(1)};
    return {-0.5 * p.continuous.squaredNorm(), -p.continuous};
  }
};

TEST(StartAt, ThePriorsDrawsAreThePriorsWhereThereIsADensity) {
  const HalfLine target;
  Rng rng(4);
  double mean = 0, level = 0;
  constexpr int kStarts = 4000;
  for (int i = 0; i < kStarts; ++i) {
    const ChainState start = start_at(
        target, [&](Rng& r) { return prior_draw(target, r); }, rng);
    ASSERT_GE(start.position.continuous[0], -1.5);
    ASSERT_EQ(start.evaluation.log_density, target.evaluate(start.position).log_density);
    mean += start.position.continuous[0] / kStarts;
    level += start.position.discrete[0] / static_cast<double>(kStarts);
  }
  EXPECT_NEAR(mean, 0.1295 / 0.9332, 5 / std::sqrt(kStarts));  // phi(1.5) / Phi(1.5)
  EXPECT_NEAR(level, 1.5, 5 * 1.12 / std::sqrt(kStarts));
}

TEST(StartAt, ThrowsWhereThereIsNone) {
  const HalfLine target;
  Rng rng(4);
  const Position outside{Eigen::VectorXd::Constant(1, -2), Eigen::VectorXi::Zero(1)};
  EXPECT_NE(user_error([&] {
              start_at(
                  target, [&](Rng&) { return outside; }, rng);
            }),
            "");
}

}  // namespace
}  // namespace patina
