#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/chart/setting.h"
#include "engine/run/run_settings.h"
#include "engine/run/stop_rules.h"

namespace patina {

/// A way of drawing, as `patina-cli chart` measured it.
struct DrawingCost {
  ChartSetting setting;
  double seconds = 0;          ///< for what one independent draw is worth, search and warm-up included
  double error = 0;            ///< of the worst mean, in posterior sds, after the chart's time
  bool beyond_chance = false;  ///< few draws alone do not explain the error: the way itself is off
};

/// What ways of drawing cost for a material, and how far off they are.
struct CostChart {
  std::string target;              ///< what was charted: "bump at 64 pixels, ..."
  std::vector<DrawingCost> costs;  ///< of those that had draws in their time
  std::vector<std::size_t> front;  ///< of costs, the cheapest first: none is better in both
};

/// Nothing if there is no such file. @throws UserError for a file that is no chart.csv
std::optional<CostChart> read_cost_chart(const std::filesystem::path& file);

/// Where the program keeps its own chart of a material.
std::filesystem::path bundled_chart_file(const std::string& material);

/// Which of the chart's ways a run with these settings goes; its resolution and lengths do not matter.
std::optional<std::size_t> find_cost(const CostChart& chart, const RunSettings& settings);

/// What a run's draws have cost so far, how far their means can be trusted, and what half the error takes:
/// sentences. Empty where there are too few draws to tell.
/// @param seconds  since the run began   @param rate  draws a second
std::string spent_text(const StopEvidence& evidence, double seconds, double rate);

/// Which ways are cheaper than one of them, and which of these are as right: sentences.
/// @param own  of chart.costs
std::string alternatives_text(const CostChart& chart, std::size_t own);

}  // namespace patina
