#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/calibration/report.h"

namespace patina {

/// All parameters that some studies identified, together. Of eighty whose 90 % intervals are right, a few lie
/// far from 90 % by chance: whether more do than that, no line of a table tells.
struct OverallCoverage {
  int parameters = 0;
  std::array<double, kIntervals.size()> share{};  ///< mean over parameters, per interval
  double scatter = 0;            ///< of the 90 % interval's shares about 0.9, root mean square
  double scatter_by_chance = 0;  ///< the binomial law's
  int outside = 0;               ///< parameters whose share falls short of what is asked of it
  double outside_by_chance = 0;  ///< expected, of as many photos
};

OverallCoverage overall_coverage(const std::vector<CalibrationReport>& reports);

/// A section in Markdown; nothing where no parameter was identified.
std::string to_markdown(const OverallCoverage& overall);

}  // namespace patina
