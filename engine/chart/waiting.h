#pragma once

#include <string>
#include <vector>

#include "engine/chart/gold_standard.h"
#include "engine/chart/table_file.h"
#include "engine/chart/trial.h"

namespace patina {

/// What someone who waits has after a time: the mean of all draws so far, or the best match before the first.
struct WaitingPoint {
  double seconds = 0;  ///< since the start
  double error = 0;    ///< the largest |estimate - gold mean| / gold sd of a continuous quantity
  long draws = 0;      ///< after warm-up, of all chains; 0: it is the best match
  bool operator==(const WaitingPoint&) const = default;
};

/// At ten times a decade, the same ones for every trial, from the first match to the first such time at which
/// the trial has ended.
std::vector<WaitingPoint> waiting_curve(const Trial& trial, const GoldStandard& gold);

/// The curve of a repeat of a setting: rows of waiting.csv.
struct WaitingCurve {
  std::string setting;
  int repeat = 0;
  std::vector<WaitingPoint> points;
  bool operator==(const WaitingCurve&) const = default;
};

TableFile waiting_table(const std::vector<WaitingCurve>& curves);
/// @throws UserError for another table
std::vector<WaitingCurve> waiting_curves(const TableFile& table);

/// The median over a setting's repeats, at the times that more than half of them have.
std::vector<WaitingPoint> median_curve(const std::vector<WaitingCurve>& curves, const std::string& setting);

}  // namespace patina
