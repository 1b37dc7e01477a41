#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/chart/chart_row.h"
#include "engine/chart/gold_standard.h"
#include "engine/chart/problem.h"

namespace patina {

/// What is charted, beside the problem.
struct ChartPlan {
  std::vector<ChartSetting> settings;  ///< of different names
  int repeats = 3;                     ///< of each setting
  TrialPlan trial;                     ///< limits of every repeat; its seed is the first repeat's
  GoldPlan gold;
  std::string program;  ///< and its version
};

/// The limits and seeds of a chart whose trials have so many seconds each (0: no limit) and, at most, so many
/// draws a chain.
/// @param gold_seconds  of each of the gold standard's settings   @param gold_draws  likewise, of a chain
ChartPlan make_plan(std::vector<ChartSetting> settings, std::uint64_t seed, double seconds, int draws,
                    double gold_seconds, int gold_draws);

/// Tries every setting, `repeats` times, under the same limits; repeats of the settings alternate, so that
/// what disturbs the machine for a while disturbs them alike. Writes chart.csv, a row per repeat;
/// waiting.csv, the curve of each; drawings of both, chart.svg and .png, waiting.svg and .png; and
/// gold/gold.csv. All are up to date after every repeat. What is there already, of the same target, limits,
/// seed and machine, is not made again.
/// @param directory  made if it is not there
/// @param progress   told one line now and then; may be empty
/// @return the rows of chart.csv
/// @throws UserError for a directory that holds another chart, and where writing fails
std::vector<ChartRow> make_chart(const ChartProblem& problem, const ChartPlan& plan,
                                 const std::filesystem::path& directory,
                                 const std::function<void(const std::string&)>& progress = {});

}  // namespace patina
