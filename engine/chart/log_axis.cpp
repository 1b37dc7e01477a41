#include "engine/chart/log_axis.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/format.h"

namespace patina {

double LogAxis::pixel(double value) const {
  assert(0 < low && low < high);
  const double along = std::log(std::clamp(value, low, high) / low) / std::log(high / low);
  return pixel_of_low + along * (pixel_of_high - pixel_of_low);
}

LogAxis fitted_axis(const std::vector<double>& values, double room_below, double room_above) {
  constexpr double kLeastSpan = 4;
  double least = INFINITY, largest = 0;
  for (const double value : values) {
    if (!(value > 0) || !std::isfinite(value)) continue;
    least = std::min(least, value);
    largest = std::max(largest, value);
  }
  if (largest == 0) least = largest = 1;
  const double widen = std::sqrt(std::max(kLeastSpan / (largest / least), 1.0));
  return {least / widen / room_below, largest * widen * room_above};
}

std::vector<Tick> log_ticks(double low, double high) {
  constexpr double kFewDecades = 2.2;
  const bool few = std::log10(high / low) < kFewDecades;
  std::vector<Tick> ticks;
  for (int decade = static_cast<int>(std::floor(std::log10(low))); std::pow(10.0, decade) <= high; ++decade)
    for (int digit = 1; digit <= 9; ++digit) {
      const double value = digit * std::pow(10.0, decade);
      if (value < low || value > high) continue;
      const bool labelled = digit == 1 || (few && (digit == 2 || digit == 5));
      ticks.push_back({value, labelled ? format("%.6g", value) : ""});
    }
  return ticks;
}

}  // namespace patina
