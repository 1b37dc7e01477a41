#include "engine/chart/chart_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/chart/gold_standard.h"
#include "engine/error.h"
#include "engine/io/temporary_folder.h"
#include "engine/run/run_settings.h"
#include "engine/sampling/rng.h"

namespace patina {
namespace {

bool beats(const CostError& a, const CostError& b) {
  return a.cost <= b.cost && a.error <= b.error && (a.cost < b.cost || a.error < b.error);
}

/// By its definition, every pair compared.
std::vector<std::size_t> enumerated_front(const std::vector<CostError>& points) {
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (std::ranges::none_of(points, [&](const CostError& other) { return beats(other, points[i]); }))
      front.push_back(i);
  return front;
}

TEST(ParetoFront, is_what_no_other_point_beats_also_among_ties) {
  Rng rng(1);
  for (int repeat = 0; repeat < 300; ++repeat) {
    std::vector<CostError> points(static_cast<std::size_t>(1 + rng.below(12)));
    for (CostError& point : points) point = {1.0 + rng.below(6), 1.0 + rng.below(6)};
    std::vector<std::size_t> front = pareto_front(points);
    EXPECT_TRUE(std::ranges::is_sorted(front, {}, [&](std::size_t i) { return points[i].cost; }));
    std::ranges::sort(front);
    EXPECT_EQ(front, enumerated_front(points));
  }
}

TEST(ParetoFront, leaves_out_what_has_no_cost_or_error) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(pareto_front({{kNaN, 1}, {2, 3}, {1, kNaN}, {INFINITY, 0}}), std::vector<std::size_t>{1});
  EXPECT_TRUE(pareto_front({}).empty());
}

ChartRow some_row(const std::string& name, int repeat, double ess, double error) {
  ChartRow row;
  row.setting = default_setting();
  row.setting.name = name;
  row.setting.path_length = 0.1;
  row.repeat = repeat;
  row.seed = 18446744073709551615u;
  row.draws = 4000;
  row.seconds = 12.25;
  row.evaluations = 30000;
  row.accuracy.least_ess = ess;
  row.accuracy.mean = {error, 0.01, "rough", error / 0.01};
  row.accuracy.levels.value = std::numeric_limits<double>::quiet_NaN();
  return row;
}

TEST(ChartRow, is_read_back_from_its_file_to_the_bit) {
  const TemporaryFolder folder;
  TableFile table{{{"target", "x = 1, y"}}, chart_columns(), {}};
  const std::vector<ChartRow> rows{some_row("default", 1, 1.0 / 3, 0.02), some_row("a b", 2, NAN, 0.1)};
  for (const ChartRow& row : rows) table.rows.push_back(chart_cells(row));
  write_table(folder.path() / "chart.csv", table);
  const TableFile back = read_table(folder.path() / "chart.csv").value();
  EXPECT_EQ(back.value("target"), "x = 1, y");
  const std::vector<ChartRow> read = chart_rows(back);
  ASSERT_EQ(read.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read[i].setting, rows[i].setting);
    EXPECT_EQ(read[i].seed, rows[i].seed);
    EXPECT_EQ(chart_cells(read[i]), chart_cells(rows[i]));
  }
}

TEST(ChartRow, of_a_file_that_is_no_chart_is_refused) {
  const TemporaryFolder folder;
  write_table(folder.path() / "x.csv", {{}, {"a", "b"}, {{"1", "2"}}});
  EXPECT_THROW(chart_rows(read_table(folder.path() / "x.csv").value()), UserError);
  TableFile table{{}, chart_columns(), {chart_cells(some_row("default", 1, 3, 0.02))}};
  const auto resolution = std::ranges::find(table.columns, "resolution") - table.columns.begin();
  table.rows[0][static_cast<std::size_t>(resolution)] = "many";
  EXPECT_THROW(chart_rows(table), UserError);
  EXPECT_THROW(parse_number("1e"), UserError);
}

TEST(ChartPoints, are_medians_over_repeats_with_their_range_in_order_of_appearance) {
  const std::vector<ChartRow> rows{some_row("b", 1, 100, 0.02), some_row("default", 1, 50, 0.2),
                                   some_row("b", 2, 300, 0.01), some_row("b", 3, 200, 0.09)};
  const std::vector<ChartPoint> points = chart_points(rows);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].name, "b");
  EXPECT_EQ(points[0].repeats, 3);
  EXPECT_FALSE(points[0].is_default);
  EXPECT_TRUE(points[1].is_default);
  EXPECT_DOUBLE_EQ(points[0].evaluations_per_draw.median, 150);
  EXPECT_DOUBLE_EQ(points[0].evaluations_per_draw.low, 100);
  EXPECT_DOUBLE_EQ(points[0].evaluations_per_draw.high, 300);
  EXPECT_DOUBLE_EQ(points[0].mean.value.median, 0.02);
  EXPECT_FALSE(points[0].mean.beyond_chance) << "in one repeat of three";
  EXPECT_TRUE(points[1].mean.beyond_chance);
  EXPECT_TRUE(std::isnan(points[0].levels.value.median));
}

TEST(ChartSettings, of_a_preset_have_different_names_and_begin_with_the_default) {
  for (const std::string& preset : chart_presets()) {
    const auto settings =
        preset_settings(preset, {.resolution = 64, .least_resolution = 32, .has_discrete = true});
    EXPECT_GE(settings.size(), preset == "quick" ? 8u : 25u);
    ChartSetting first = default_setting();
    first.warmup = settings.front().warmup;
    EXPECT_EQ(settings.front(), first);
    for (std::size_t i = 0; i < settings.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_NE(settings[i].name, settings[j].name);
        ChartSetting same_name = settings[i];
        same_name.name = settings[j].name;
        EXPECT_NE(same_name, settings[j]) << settings[i].name << " is " << settings[j].name;
      }
  }
}

TEST(ChartSettings, fit_their_target) {
  const auto jagged = preset_settings("full", {.resolution = 64, .least_resolution = 60, .has_jagged = true});
  for (const ChartSetting& setting : jagged) {
    EXPECT_GT(setting.refresh, 0) << "nothing else moves jagged coordinates";
    EXPECT_EQ(setting.resolution, 0) << "no coarser one can be looked at";
  }
  EXPECT_THROW(preset_settings("slow", {}), std::invalid_argument);
}

TEST(ChartSettings, keep_fewer_levels_of_a_network_that_has_them) {
  for (const int levels : {0, 3, 5}) {
    const auto settings =
        preset_settings("full", {.summary = "gram+rings", .resolution = 64, .levels = levels});
    const auto kept = [](const ChartSetting& setting) {
      return setting.name.find(" level") != setting.name.npos;
    };
    EXPECT_EQ(std::ranges::count_if(settings, kept), std::max(0, levels - 1));
    EXPECT_EQ(std::ranges::count(settings, "gram2+rings", &ChartSetting::summary), levels > 2);
  }
}

TEST(ChartSettings, emulate_what_is_smooth) {
  for (const bool smooth : {false, true})
    for (const std::string& preset : chart_presets()) {
      const auto settings = preset_settings(preset, {.resolution = 64, .can_emulate = smooth});
      EXPECT_EQ(std::ranges::count(settings, "emulated", &ChartSetting::kernel), smooth) << preset;
    }
}

TEST(ChartSettings, of_a_jagged_target_that_can_be_emulated_are_no_fewer) {
  // Though warm-up is as long as a smooth one's for the default, and longer for all that it is set against.
  for (const std::string& preset : chart_presets()) {
    const ChartTarget plain{.resolution = 64, .has_jagged = true};
    ChartTarget emulated = plain;
    emulated.can_emulate = true;
    EXPECT_EQ(preset_settings(preset, emulated).size(), preset_settings(preset, plain).size() + 1) << preset;
  }
}

TEST(ChartSettings, average_over_irregularities_where_there_are_any) {
  for (const bool can_average : {false, true})
    for (const std::string& preset : chart_presets()) {
      const auto settings = preset_settings(
          preset, {.resolution = 64, .has_jagged = true, .can_emulate = true, .can_average = can_average});
      EXPECT_EQ(std::ranges::count(settings, "averaged", &ChartSetting::errors), can_average) << preset;
      EXPECT_EQ(settings.front().errors, can_average ? "averaged" : "paper") << "the default is a run's";
      const auto by_hand = std::ranges::find_if(settings, [](const ChartSetting& setting) {
        return setting.kernel == kEmulated && setting.errors == "paper";
      });
      ASSERT_NE(by_hand, settings.end()) << "what averaging changes shows beside it";
      EXPECT_EQ(by_hand->name, can_average ? kHandSet : kDefaultSetting);
    }
}

TEST(ChartSettings, of_a_gold_standard_draw_from_the_target_itself) {
  const ChartTarget target{.resolution = 64, .has_jagged = true, .can_emulate = true, .can_average = true};
  for (const ChartSetting& setting : gold_settings(default_setting(target)))
    EXPECT_EQ(setting.errors, "paper") << setting.name;
}

TEST(ChartSettings, round_where_that_pays) {
  for (const bool can_round : {false, true}) {
    const auto settings = preset_settings("quick", {.resolution = 64, .can_round = can_round});
    EXPECT_EQ(std::ranges::count(settings, "bfloat16", &ChartSetting::precision), can_round);
  }
}

TEST(ChartSettings, of_one_warmup_still_differ) {
  const auto all = preset_settings("full", {.resolution = 64});
  const auto settings = with_warmup(all, 40);
  const auto others = std::ranges::count_if(
      all, [&](const ChartSetting& setting) { return setting.warmup != all.front().warmup; });
  EXPECT_EQ(others, 4);
  EXPECT_EQ(std::ssize(settings), std::ssize(all) - others);
  for (const ChartSetting& setting : settings) EXPECT_EQ(setting.warmup, 40);
}

}  // namespace
}  // namespace patina
