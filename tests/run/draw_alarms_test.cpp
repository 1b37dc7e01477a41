#include "engine/run/draw_alarms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace patina {
namespace {

constexpr int kChains = 4, kDraws = 500;

/// Two parameters on [0, 1] and a choice.
ParameterTable table() {
  ParameterTable table;
  table.material = "small";
  table.continuous = {{"a", "", "", {0.5, 0.25, 0, 1}}, {"b", "", "", {0.5, 0.25, 0, 1}}};
  table.discrete = {{"choice", "", {"one", "two"}}};
  return table;
}

using Spoil = std::function<void(Draw&)>;

/// Independent draws of a, b ~ N(0.5, 0.1^2), each then spoiled.
std::vector<Draw> draws(const Spoil& spoil = {}, int chains = kChains) {
  std::mt19937 generator(8);
  std::normal_distribution<double> normal;
  std::vector<Draw> draws;
  for (int k = 0; k < chains; ++k)
    for (int i = 0; i < kDraws; ++i) {
      Draw draw;
      draw.chain = k;
      draw.iteration = i;
      draw.lp = -std::abs(normal(generator));
      draw.energy = -draw.lp + 1 + 0.1 * normal(generator);
      draw.values = {{0.5 + 0.1 * normal(generator), 0.5 + 0.1 * normal(generator)}, {0}};
      if (spoil) spoil(draw);
      draws.push_back(draw);
    }
  return draws;
}

const Alarm* find(const RunSummary& summary, const std::string& name) {
  const auto found = std::ranges::find(summary.alarms, name, &Alarm::name);
  return found == summary.alarms.end() ? nullptr : &*found;
}

/// The only alarm, of that name, with these words in its sentence.
void expect_only(const RunSummary& summary, const std::string& name, const std::vector<std::string>& words) {
  ASSERT_EQ(summary.alarms.size(), 1u) << name;
  EXPECT_EQ(summary.alarms[0].name, name);
  for (const std::string& word : words)
    EXPECT_NE(summary.alarms[0].sentence.find(word), std::string::npos)
        << word << " in: " << summary.alarms[0].sentence;
}

TEST(DrawAlarms, good_draws_raise_none) { EXPECT_TRUE(summarize_draws(table(), draws()).alarms.empty()); }

TEST(DrawAlarms, no_draws_raise_none) { EXPECT_TRUE(summarize_draws(table(), {}).alarms.empty()); }

TEST(DrawAlarms, one_chain_has_nothing_to_disagree_with) {
  expect_only(summarize_draws(table(), draws({}, 1)), "alone", {"One chain"});
}

TEST(DrawAlarms, a_chain_that_never_moved_is_named) {
  const auto spoil = [](Draw& draw) {
    if (draw.chain == 2) draw.values = {{0.5, 0.5}, {0}};
  };
  const RunSummary summary = summarize_draws(table(), draws(spoil));
  const Alarm* alarm = find(summary, "stuck");
  ASSERT_NE(alarm, nullptr);
  EXPECT_NE(alarm->sentence.find("moved: 3."), std::string::npos) << alarm->sentence;
}

TEST(DrawAlarms, modes_that_chains_do_not_pass_between_are_told_with_their_shares) {
  const auto apart = [](Draw& draw) { draw.values.continuous[0] += draw.chain == 0 ? -0.45 : 0.3; };
  const auto narrow = [&](Draw& draw) {
    draw.values.continuous[0] = 0.5 + 0.1 * (draw.values.continuous[0] - 0.5);
    apart(draw);
  };
  expect_only(summarize_draws(table(), draws(narrow)), "modes",
              {"2 separate", "25 %", "75 %", "only 0 times"});
}

TEST(DrawAlarms, levels_that_chains_do_not_pass_between_are_modes_as_well) {
  const auto spoil = [](Draw& draw) { draw.values.discrete[0] = draw.chain % 2; };
  EXPECT_NE(find(summarize_draws(table(), draws(spoil)), "modes"), nullptr);
}

TEST(DrawAlarms, modes_that_chains_pass_between_often_are_none) {
  const auto hop = [](Draw& draw) {
    draw.values.discrete[0] = draw.iteration % 7 < 3;
    draw.values.continuous[0] =
        (draw.iteration % 5 < 2 ? 0.2 : 0.8) + 0.1 * (draw.values.continuous[0] - 0.5);
  };
  EXPECT_EQ(find(summarize_draws(table(), draws(hop)), "modes"), nullptr);
}

TEST(DrawAlarms, more_than_a_hundredth_of_divergent_steps_is_told) {
  const auto every = [](int many) {
    return [=](Draw& draw) { draw.divergent = draw.iteration % many == 0 && draw.chain == 1; };
  };
  expect_only(summarize_draws(table(), draws(every(50))), "divergences", {"2.0 %", "chain 2"});
  EXPECT_TRUE(summarize_draws(table(), draws(every(125))).alarms.empty());
}

TEST(DrawAlarms, energies_that_crawl_are_told_of_kernels_with_trajectories_alone) {
  const auto crawl = [](Draw& draw) { draw.energy = 0.1 * static_cast<double>(draw.iteration); };
  expect_only(summarize_draws(table(), draws(crawl)), "energy", {"Chain 1", "E-BFMI"});
  const auto walk = [](Draw& draw) { draw.energy = -(draw.lp = 0.1 * static_cast<double>(draw.iteration)); };
  EXPECT_TRUE(summarize_draws(table(), draws(walk)).alarms.empty());
}

TEST(DrawAlarms, a_parameter_piled_at_a_bound_is_told_with_the_bound) {
  const auto high = [](Draw& draw) {
    draw.values.continuous[1] = 1 - 0.1 * std::abs(draw.values.continuous[1] - 0.5);
  };
  expect_only(summarize_draws(table(), draws(high)), "bound", {"of b", "upper bound 1"});
  const auto low = [](Draw& draw) {
    draw.values.continuous[0] = 0.1 * std::abs(draw.values.continuous[0] - 0.5);
  };
  expect_only(summarize_draws(table(), draws(low)), "bound", {"of a", "lower bound 0"});
}

TEST(DrawAlarms, a_prior_that_is_itself_piled_at_its_bound_raises_none) {
  ParameterTable steep = table();
  steep.continuous[0].prior = {0, 0.01, 0, 1};
  const auto spoil = [](Draw& draw) {
    draw.values.continuous[0] = 0.1 * std::abs(draw.values.continuous[0] - 0.5);
  };
  EXPECT_TRUE(summarize_draws(steep, draws(spoil)).alarms.empty());
}

}  // namespace
}  // namespace patina
