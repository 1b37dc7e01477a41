#include "engine/stress/report.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace patina {
namespace {

Cell cell(const std::string& scenario, const std::string& kernel, Outcome outcome, double error) {
  Cell cell{scenario, "what it is", "closed form", kernel, {}, outcome};
  cell.evidence.error = {"x", error, 0.01};
  cell.evidence.seconds = 1.25;
  cell.evidence.alarms = {{"noise", "A sentence."}};
  cell.evidence.is_short = true;  // no word on R-hat
  return cell;
}

std::vector<Cell> some_cells() {
  return {cell("a", "mh", Outcome::right, 0.04), cell("a", "hmc", Outcome::silent, 0.5),
          cell("b", "mh", Outcome::alarmed, std::numeric_limits<double>::infinity()),
          cell("b", "hmc", Outcome::refused, 0)};
}

TEST(Report, has_a_row_per_scenario_a_column_per_kernel_and_the_count_of_each_outcome) {
  EXPECT_EQ(
      report_table(some_cells()),
      "| scenario | known by | mh | hmc | s |\n"
      "|---|---|---|---|---|\n"
      "| **a**: what it is | closed form | right 0.04 ± 0.01 (noise) | SILENT 0.50 ± 0.01 (noise) | 2.5 |\n"
      "| **b**: what it is | closed form | alarmed no answer (noise) | refused | 2.5 |\n"
      "\nright 1, alarmed 1, refused 1, SILENT 1; 5 s in all.\n");
}

TEST(Report, replaces_the_table_of_a_page_and_leaves_the_rest) {
  const std::string page = "# Title\n<!-- a -->\nold\n<!-- /a -->\nafter\n<!-- b -->\n<!-- /b -->\n";
  const std::string made = with_table(page, "a", "new\n");
  EXPECT_EQ(made, "# Title\n<!-- a -->\nnew\n<!-- /a -->\nafter\n<!-- b -->\n<!-- /b -->\n");
  EXPECT_EQ(with_table(made, "a", "new\n"), made);
  EXPECT_EQ(with_table("no marks\n", "a", "new\n"), "no marks\n\n<!-- a -->\nnew\n<!-- /a -->\n");
  EXPECT_EQ(with_table("", "a", "new\n"), "<!-- a -->\nnew\n<!-- /a -->\n");
}

TEST(Report, in_json_has_every_cell_and_null_for_what_is_no_number) {
  const nlohmann::ordered_json json = report_json(some_cells());
  ASSERT_EQ(json["cells"].size(), 4u);
  EXPECT_EQ(json["cells"][0]["outcome"], "right");
  EXPECT_EQ(json["cells"][1]["alarms"][0]["sentence"], "A sentence.");
  EXPECT_TRUE(json["cells"][2]["error"].is_null());
}

}  // namespace
}  // namespace patina
