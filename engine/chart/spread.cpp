#include "engine/chart/spread.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/diagnostics/ranks.h"

namespace patina {

Spread spread_of(std::vector<double> values) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return {kNaN, kNaN, kNaN};
  const double low = *std::ranges::min_element(values), high = *std::ranges::max_element(values);
  return {quantile_of(values, 0.5), low, high};
}

}  // namespace patina
