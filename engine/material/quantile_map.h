#pragma once

#include <span>
#include <vector>

namespace patina {

/// One point of a map's wanted distribution.
struct QuantileKnot {
  double probability;
  float value;
};

/// Bends values by a monotone, piecewise linear curve so that their quantiles become the knots'. Knots are in
/// ascending order and run from probability 0 to 1.
void map_to_quantiles(std::span<float> values, std::span<const QuantileKnot> knots);

}  // namespace patina
