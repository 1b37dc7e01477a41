#include <gtest/gtest.h>

#include "engine/chart/chart_row.h"
#include "engine/error.h"
#include "engine/io/file.h"
#include "engine/io/temporary_folder.h"
#include "gui/plot/cost_chart.h"

namespace patina {
namespace {

ChartRow row(const char* name, double seconds_a_draw, double error, double bars) {
  ChartRow row;
  row.setting = default_setting();
  row.setting.name = name;
  row.seconds = 100 * seconds_a_draw;
  row.accuracy.least_ess = 100;
  row.accuracy.mean = {error, error / bars, "rough", bars};
  return row;
}

/// The default in the middle: nuts is cheaper and as right, 32 pixels is cheapest and wrong, mh is dear.
std::vector<ChartRow> rows() {
  std::vector<ChartRow> rows{row(kDefaultSetting, 0.5, 0.08, 1), row("nuts", 0.25, 0.1, 2),
                             row("32 pixels", 0.05, 0.6, 9), row("mh", 8, 0.4, 1)};
  rows[1].setting.kernel = "nuts";
  rows[2].setting.resolution = 32;
  rows[3].setting.kernel = "mh";
  return rows;
}

class CostChartTest : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::vector<ChartRow>& rows) const {
    TableFile table;
    table.header = {{"target", "bump at 64 pixels"}};
    table.columns = chart_columns();
    for (const ChartRow& row : rows) table.rows.push_back(chart_cells(row));
    write_table(folder_.path() / "chart.csv", table);
    return folder_.path() / "chart.csv";
  }

  TemporaryFolder folder_;
};

TEST_F(CostChartTest, HasWhatEverySettingCostsAndTheFrontFromCheapToRight) {
  const CostChart chart = read_cost_chart(write(rows())).value();
  EXPECT_EQ(chart.target, "bump at 64 pixels");
  ASSERT_EQ(chart.costs.size(), 4u);
  EXPECT_DOUBLE_EQ(chart.costs[1].seconds, 0.25);
  EXPECT_DOUBLE_EQ(chart.costs[1].error, 0.1);
  EXPECT_TRUE(chart.costs[2].beyond_chance);
  EXPECT_FALSE(chart.costs[1].beyond_chance);
  EXPECT_EQ(chart.front, (std::vector<std::size_t>{2, 1, 0}));
}

TEST_F(CostChartTest, LeavesOutWhatHadNoDrawsInItsTime) {
  std::vector<ChartRow> some = rows();
  some[3].accuracy = {};
  some[3].accuracy.least_ess = std::nan("");
  some[3].accuracy.mean.value = std::nan("");
  EXPECT_EQ(read_cost_chart(write(some))->costs.size(), 3u);
}

TEST_F(CostChartTest, FindsTheWayOfARunWhateverItsLengthAndResolution) {
  const CostChart chart = read_cost_chart(write(rows())).value();
  RunSettings run;
  run.draws = 17;
  run.warmup = 3;
  run.resolution = 512;
  run.refresh = default_setting().refresh;
  EXPECT_EQ(find_cost(chart, run), 0u);
  run.kernel = "nuts";
  EXPECT_EQ(find_cost(chart, run), 1u);
  run.chains = 7;
  EXPECT_FALSE(find_cost(chart, run));
}

TEST_F(CostChartTest, FindsTheWayOfARunThatAveragesOverIrregularities) {
  std::vector<ChartRow> some = rows();
  RunSettings run;
  run.refresh = default_setting().refresh;
  run.errors = "averaged";
  EXPECT_FALSE(find_cost(read_cost_chart(write(some)).value(), run));
  const ChartTarget jagged{.has_jagged = true, .can_emulate = true, .can_average = true};
  some[0].setting = some[3].setting = default_setting(jagged);
  some[3].setting.name = kHandSet;
  some[3].setting.errors = "paper";
  const CostChart chart = read_cost_chart(write(some)).value();
  run.refresh = some[0].setting.refresh;
  EXPECT_EQ(find_cost(chart, run), 0u);
  run.errors = kAuto;
  EXPECT_EQ(find_cost(chart, run), 0u) << "what a run does that is told nothing";
  run.errors = "paper";
  EXPECT_EQ(find_cost(chart, run), 3u);
}

TEST_F(CostChartTest, SaysWhichWaysAreCheaperAndWhichOfTheseAreWrong) {
  const CostChart chart = read_cost_chart(write(rows())).value();
  const std::string of_default = alternatives_text(chart, 0);
  EXPECT_NE(of_default.find("nuts (0.5 times the time a draw)"), std::string::npos) << of_default;
  EXPECT_NE(of_default.find("wrong: 32 pixels (0.1 times the time a draw, averages 0.6 spreads away)"),
            std::string::npos)
      << of_default;
  EXPECT_EQ(of_default.find("mh"), std::string::npos) << "it is dearer";
  EXPECT_NE(alternatives_text(chart, 1).find("No other way"), std::string::npos);
}

TEST_F(CostChartTest, DoesNotCallAnotherErrorModelWrong) {
  std::vector<ChartRow> some = rows();
  some[2].setting.errors = "calibrated";
  const std::string text = alternatives_text(*read_cost_chart(write(some)), 0);
  EXPECT_EQ(text.find("wrong"), std::string::npos) << text;
  EXPECT_NE(text.find("other assumptions about errors: 32 pixels"), std::string::npos) << text;
}

TEST_F(CostChartTest, SaysWhatDrawsCostAndWhatHalfTheErrorTakes) {
  const StopEvidence evidence{.draws = 1000,
                              .least_ess_of = "rough",
                              .least_ess = 400,
                              .largest_rhat_of = "rough",
                              .largest_rhat = 1};
  const std::string text = spent_text(evidence, 200, 10);
  EXPECT_NE(text.find("0.5 s for each of 400 independent draws"), std::string::npos) << text;
  EXPECT_NE(text.find("about 5 % of"), std::string::npos) << "1 / sqrt(400): " << text;
  EXPECT_NE(text.find("about 5 minutes"), std::string::npos) << "3000 more draws at 10 a second: " << text;
  EXPECT_EQ(spent_text({}, 200, 10), "");
}

TEST_F(CostChartTest, IsNothingWhereThereIsNoFileAndASentenceWhereItIsNoChart) {
  EXPECT_FALSE(read_cost_chart(folder_.path() / "none.csv"));
  write_file_atomically(folder_.path() / "other.csv", "a,b\n1,2\n");
  EXPECT_THROW(read_cost_chart(folder_.path() / "other.csv"), UserError);
}

}  // namespace
}  // namespace patina
