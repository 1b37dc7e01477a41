#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/chart/accuracy.h"
#include "engine/chart/setting.h"
#include "engine/chart/table_file.h"
#include "engine/chart/trial.h"

namespace patina {

/// A finished repeat of a setting: a row of chart.csv.
struct ChartRow {
  ChartSetting setting;
  int repeat = 0;
  std::uint64_t seed = 0;
  long draws = 0;  ///< after warm-up, all chains together
  double seconds = 0, search_seconds = 0, warmup_seconds = 0, processor_seconds = 0;
  long evaluations = 0, search_evaluations = 0, warmup_evaluations = 0, value_evaluations = 0;
  Accuracy accuracy;

  // What an effective draw of the worst quantity costs, search and warm-up included.
  double seconds_per_draw() const { return seconds / accuracy.least_ess; }
  double evaluations_per_draw() const { return static_cast<double>(evaluations) / accuracy.least_ess; }
};

ChartRow make_row(const ChartSetting& setting, int repeat, const TrialPlan& plan, const Trial& trial,
                  const Accuracy& accuracy);

/// A setting's columns and their cells.
std::vector<std::pair<std::string, std::string>> setting_cells(const ChartSetting& setting);

/// The columns of chart.csv; the last two, costs of an effective draw, follow from the others.
std::vector<std::string> chart_columns();
std::vector<std::string> chart_cells(const ChartRow& row);

/// Rows of a table that has chart_columns(). @throws UserError for another table
std::vector<ChartRow> chart_rows(const TableFile& table);

}  // namespace patina
