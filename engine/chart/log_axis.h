#pragma once

#include <string>
#include <vector>

namespace patina {

/// A logarithmic axis along one side of a panel.
struct LogAxis {
  double low = 1, high = 10;  ///< of the quantity, positive
  double pixel_of_low = 0, pixel_of_high = 1;

  /// Values beyond the ends lie at the ends.
  double pixel(double value) const;
};

/// From the least to the largest positive value, and some room; at least a factor of four.
/// @param room  factors below the least and above the largest
LogAxis fitted_axis(const std::vector<double>& values, double room_below, double room_above);

struct Tick {
  double value = 1;
  std::string label;  ///< empty: a small one
};

/// At 1, 2 and 5 of each decade with labels where few decades are shown, else at the decades alone; small
/// ones between.
std::vector<Tick> log_ticks(double low, double high);

}  // namespace patina
