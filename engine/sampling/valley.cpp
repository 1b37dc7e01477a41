#include "engine/sampling/valley.h"

#include <algorithm>

#include "engine/sampling/finite_evaluation.h"

namespace patina {

double valley_between(const LogDensity& target, const ChainState& from, const ChainState& to) {
  constexpr int kParts = 10;
  const double lower = std::min(from.evaluation.log_density, to.evaluation.log_density);
  double least = lower;
  for (int i = 1; i < kParts; ++i) {
    Position between = from.position;
    between.continuous +=
        (static_cast<double>(i) / kParts) * (to.position.continuous - from.position.continuous);
    least = std::min(least, value_finite(target, between).log_density);
  }
  return lower - least;
}

}  // namespace patina
