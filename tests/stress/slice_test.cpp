#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "engine/stress/density.h"
#include "engine/stress/report.h"
#include "engine/stress/scenarios.h"
#include "engine/stress/suite.h"

// A slice of `patina-cli stress` that is fit for every build; all of it runs at night (label nightly).

namespace patina {
namespace {

/// Densities, and photos of bump.
std::vector<Scenario> all_scenarios() {
  std::vector<Scenario> all = density_scenarios();
  std::ranges::move(photo_scenarios("bump"), std::back_inserter(all));
  return all;
}

Scenario scenario(const std::string& name) {
  std::vector<Scenario> all = all_scenarios();
  const auto found = std::ranges::find(all, name, &Scenario::name);
  EXPECT_NE(found, all.end()) << name;
  return *found;
}

Cell tried(const std::string& name, const std::string& kernel) {
  return try_all({scenario(name)}, {.kernels = {kernel}}).front();
}

bool warns(const Cell& cell, const std::string& name) {
  const std::vector<std::string> names = warnings(cell.evidence);
  return std::ranges::find(names, name) != names.end();
}

TEST(StressSlice, scenarios_have_names_of_their_own) {
  std::vector<std::string> names;
  for (const Scenario& each : all_scenarios()) names.push_back(each.name);
  std::ranges::sort(names);
  EXPECT_TRUE(std::ranges::adjacent_find(names) == names.end());
}

TEST(StressSlice, parameters_piled_at_a_bound_are_right_and_told) {
  const Cell cell = tried("bound", "hmc");
  EXPECT_EQ(cell.outcome, Outcome::right) << cell_text(cell);
  EXPECT_TRUE(warns(cell, "bound")) << cell_text(cell);
}

TEST(StressSlice, a_ridge_is_right_with_nuts_and_never_silent) {
  const Cell right = tried("ridge", "nuts"), hard = tried("ridge", "mala");
  EXPECT_EQ(right.outcome, Outcome::right) << cell_text(right);
  EXPECT_TRUE(warnings(right.evidence).empty()) << cell_text(right);
  EXPECT_NE(hard.outcome, Outcome::silent) << cell_text(hard);
}

TEST(StressSlice, clouds_that_no_chain_passes_between_are_told) {
  const Cell cell = tried("two clouds", "hmc");
  EXPECT_NE(cell.outcome, Outcome::silent) << cell_text(cell);
  EXPECT_TRUE(warns(cell, "modes") && warns(cell, "unconverged")) << cell_text(cell);
}

TEST(StressSlice, noise_is_told_though_nothing_in_the_draws_shows_it) {
  const Cell cell = tried("noise 1", "hmc");
  EXPECT_TRUE(warns(cell, "noise")) << cell_text(cell);
  EXPECT_FALSE(warns(tried("noise 0.05", "hmc"), "noise"));
}

TEST(StressSlice, few_draws_are_no_answer_and_told) {
  for (const char* name : {"one draw", "three draws"}) {
    const Cell cell = tried(name, "hmc");
    EXPECT_EQ(cell.outcome, Outcome::alarmed) << name << ": " << cell_text(cell);
  }
}

TEST(StressSlice, cells_do_not_depend_on_how_many_are_tried_at_a_time) {
  const std::vector<Scenario> scenarios = {scenario("one draw"), scenario("three draws")};
  const SuiteSettings one{.kernels = {"mh", "mala"}};
  SuiteSettings three = one;
  three.threads = 3;
  const std::vector<Cell> a = try_all(scenarios, one), b = try_all(scenarios, three);
  ASSERT_EQ(a.size(), 4u);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(cell_text(a[i]), cell_text(b[i]));
}

/// What the suite is for: an answer that is not the posterior's is found out, by this very machinery.
TEST(StressSlice, a_kernel_whose_answer_is_wrong_without_a_sign_is_silent) {
  const Scenario shifted = density_scenario("shifted", "", "", [] {
    KnownPosterior posterior = in_coordinates(2, [](const Position& p) {
      return Evaluation{-0.5 * p.continuous.squaredNorm(), -p.continuous};
    });
    posterior.known = {parameter(posterior, 0, 0.5, 1)};
    return posterior;
  });
  const Cell cell = try_all({shifted}, {.kernels = {"hmc"}}).front();
  EXPECT_EQ(cell.outcome, Outcome::silent) << cell_text(cell);
}

TEST(StressSlice, a_photo_of_one_grey_is_told) {
  const Cell cell = tried("constant", "mh");
  EXPECT_EQ(cell.outcome, Outcome::alarmed) << cell_text(cell);
  EXPECT_TRUE(warns(cell, "blank")) << cell_text(cell);
}

}  // namespace
}  // namespace patina
