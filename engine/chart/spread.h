#pragma once

#include <vector>

namespace patina {

/// Of repeats. NaN where none is finite.
struct Spread {
  double median = 0, low = 0, high = 0;
};

/// Values that are not finite are left out.
Spread spread_of(std::vector<double> values);

}  // namespace patina
