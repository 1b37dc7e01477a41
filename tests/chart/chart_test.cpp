#include "engine/chart/chart.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/chart/chart_points.h"
#include "engine/chart/waiting.h"
#include "engine/error.h"
#include "engine/io/file.h"
#include "engine/io/temporary_folder.h"
#include "tests/chart/gaussian_problem.h"

namespace patina {
namespace {

ChartSetting changed(const std::string& name, const std::function<void(ChartSetting&)>& change) {
  ChartSetting setting = quick_setting(name);
  change(setting);
  return setting;
}

ChartPlan small_plan(std::vector<ChartSetting> settings) {
  ChartPlan plan = make_plan(std::move(settings), 7, 0, 1000, 0, 3000);
  for (ChartSetting& setting : plan.gold.settings) setting.warmup = 300;
  plan.repeats = 2;
  plan.program = "a test";
  return plan;
}

const ChartPoint& point(const std::vector<ChartPoint>& points, const std::string& name) {
  return *std::ranges::find(points, name, &ChartPoint::name);
}

TEST(Chart, errs_by_what_a_settings_bias_is_known_to_be_and_by_chance_elsewhere) {
  const TemporaryFolder folder;
  const GaussianProblem problem;
  const ChartPlan plan = small_plan({quick_setting(), changed("mala", [](auto& s) { s.kernel = "mala"; }),
                                     changed("biased", [](auto& s) { s.summary = "biased"; })});
  const std::vector<ChartPoint> points = chart_points(make_chart(problem, plan, folder.path()));
  ASSERT_EQ(points.size(), 3u);
  EXPECT_TRUE(points[0].is_default);
  for (const char* name : {"default", "mala"}) {
    EXPECT_FALSE(point(points, name).mean.beyond_chance) << name;
    EXPECT_FALSE(point(points, name).sd.beyond_chance) << name;
    EXPECT_FALSE(point(points, name).levels.beyond_chance) << name;
  }
  const ErrorSpread& biased = point(points, "biased").mean;
  EXPECT_TRUE(biased.beyond_chance);
  EXPECT_NEAR(biased.value.median, GaussianProblem::kBias, 4 * biased.bar);
  EXPECT_TRUE(point(points, "biased").wasserstein.beyond_chance);
}

TEST(Chart, a_kernel_that_samples_twice_the_variance_is_far_off_and_not_on_the_front) {
  const TemporaryFolder folder;
  const GaussianProblem problem(std::vector<double>{});
  ChartPlan plan = small_plan({quick_setting(), changed("lenient", [](auto& s) { s.kernel = "lenient"; })});
  plan.trial.draws = 4000;
  const std::vector<ChartPoint> points = chart_points(make_chart(problem, plan, folder.path()));
  const ChartPoint& wrong = point(points, "lenient");
  EXPECT_TRUE(wrong.sd.beyond_chance);
  EXPECT_NEAR(wrong.sd.value.median, std::log(std::sqrt(2)), 4 * wrong.sd.bar);
  EXPECT_GT(wrong.sd.value.median, 6 * wrong.sd.bar);
  std::vector<CostError> places;
  for (const ChartPoint& p : points) places.push_back({p.evaluations_per_draw.median, p.sd.value.median});
  EXPECT_EQ(pareto_front(places), std::vector<std::size_t>{0}) << "the default beats it in both";
}

/// What of a row depends on chance alone and not on the clock.
std::vector<std::string> repeatable_cells(const ChartRow& row) {
  std::vector<std::string> cells = chart_cells(row);
  const std::vector<std::string> columns = chart_columns();
  std::vector<std::string> kept;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (columns[i].find("seconds") == std::string::npos) kept.push_back(cells[i]);
  return kept;
}

TEST(Chart, from_the_same_seed_twice_is_the_same_but_for_the_clock) {
  const TemporaryFolder first, second;
  const GaussianProblem problem;
  const ChartPlan plan = small_plan({quick_setting()});
  const auto one = make_chart(problem, plan, first.path()), two = make_chart(problem, plan, second.path());
  ASSERT_EQ(one.size(), 2u);
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(repeatable_cells(one[i]), repeatable_cells(two[i]));
  EXPECT_NE(one[0].seed, one[1].seed);
  EXPECT_NE(repeatable_cells(one[0]), repeatable_cells(one[1])) << "repeats differ";
}

TEST(Chart, alternates_the_repeats_of_its_settings) {
  const TemporaryFolder folder;
  const GaussianProblem problem;
  const auto rows =
      make_chart(problem, small_plan({quick_setting(), changed("mala", [](auto& s) { s.kernel = "mala"; })}),
                 folder.path());
  std::vector<std::pair<std::string, int>> order;
  for (const ChartRow& row : rows) order.emplace_back(row.setting.name, row.repeat);
  const std::vector<std::pair<std::string, int>> expected{
      {"default", 1}, {"mala", 1}, {"default", 2}, {"mala", 2}};
  EXPECT_EQ(order, expected);
}

/// Cuts the last finished repeat off a chart, as if it had been killed in it.
void lose_last_row(const std::filesystem::path& folder) {
  TableFile table = read_table(folder / "chart.csv").value();
  table.rows.pop_back();
  write_table(folder / "chart.csv", table);
}

TEST(Chart, taken_up_again_makes_only_what_is_missing) {
  const TemporaryFolder folder;
  const GaussianProblem problem;
  const ChartPlan plan = small_plan({quick_setting(), changed("mala", [](auto& s) { s.kernel = "mala"; })});
  const auto complete = make_chart(problem, plan, folder.path());
  const std::string file = read_file(folder.path() / "chart.csv");
  const long before = problem.evaluations();
  make_chart(problem, plan, folder.path());
  const long for_looking = problem.evaluations() - before;
  EXPECT_LT(for_looking, 10) << "nothing is drawn again";
  EXPECT_EQ(read_file(folder.path() / "chart.csv"), file);

  lose_last_row(folder.path());
  const auto again = make_chart(problem, plan, folder.path());
  EXPECT_EQ(problem.evaluations() - before - 2 * for_looking, complete.back().evaluations);
  ASSERT_EQ(again.size(), complete.size());
  EXPECT_EQ(chart_cells(again.front()), chart_cells(complete.front())) << "kept with its times";
  EXPECT_EQ(repeatable_cells(again.back()), repeatable_cells(complete.back()));
  const auto curves = waiting_curves(read_table(folder.path() / "waiting.csv").value());
  EXPECT_EQ(curves.size(), complete.size()) << "no curve twice";
}

TEST(Chart, makes_a_setting_anew_that_means_something_else_and_keeps_those_that_are_not_asked_for) {
  const TemporaryFolder folder;
  const GaussianProblem problem;
  ChartPlan plan = small_plan({quick_setting(), changed("other", [](auto& s) { s.kernel = "mala"; })});
  plan.repeats = 1;
  make_chart(problem, plan, folder.path());
  plan.settings = {changed("other", [](auto& s) { s.kernel = "nuts"; })};
  const auto rows = make_chart(problem, plan, folder.path());
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].setting.name, "default");
  EXPECT_EQ(rows[1].setting.kernel, "nuts");
}

TEST(Chart, refuses_a_folder_with_the_chart_of_another_target_gold_standard_or_seed) {
  const TemporaryFolder folder;
  const GaussianProblem problem, other({0.2, 0.3, 0.5});
  ChartPlan plan = small_plan({quick_setting()});
  plan.repeats = 1;
  make_chart(problem, plan, folder.path());
  const std::string gold = read_file(folder.path() / "gold" / "gold.csv");
  EXPECT_THROW(make_chart(other, plan, folder.path()), UserError);
  ChartPlan longer = plan;
  longer.gold.trial.draws += 10;
  EXPECT_THROW(make_chart(problem, longer, folder.path()), UserError);
  plan.trial.seed = plan.gold.trial.seed = 8;
  EXPECT_THROW(make_chart(problem, plan, folder.path()), UserError);
  EXPECT_EQ(read_file(folder.path() / "gold" / "gold.csv"), gold) << "and leaves it as it was";
}

TEST(Chart, says_on_which_machine_of_what_and_how_well_founded_it_is) {
  const TemporaryFolder folder;
  const GaussianProblem problem;
  ChartPlan plan = small_plan({quick_setting()});
  plan.repeats = 1;
  make_chart(problem, plan, folder.path());
  const TableFile table = read_table(folder.path() / "chart.csv").value();
  for (const char* key : {"program", "processor", "cores", "threads", "target", "seed", "limits", "gold"})
    EXPECT_FALSE(table.value(key).empty()) << key;
  EXPECT_TRUE(table.value("gold").starts_with("Gold standard by hmc curved and mala dense"))
      << table.value("gold");
  for (const char* name : {"chart.svg", "chart.png", "waiting.svg", "waiting.png"})
    EXPECT_GT(std::filesystem::file_size(folder.path() / name), 1000u) << name;
}

}  // namespace
}  // namespace patina
