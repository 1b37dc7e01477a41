#include "engine/material/quantile_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace patina {

void map_to_quantiles(std::span<float> values, std::span<const QuantileKnot> knots) {
  assert(knots.size() >= 2 && knots.front().probability == 0 && knots.back().probability == 1);
  std::vector<float> sorted(values.begin(), values.end());
  std::vector<float> source;
  auto begin = sorted.begin();
  for (const QuantileKnot& knot : knots) {
    const auto index =
        static_cast<std::ptrdiff_t>(std::llround(knot.probability * static_cast<double>(sorted.size() - 1)));
    const auto place = sorted.begin() + index;
    if (place >= begin && begin != sorted.end()) std::nth_element(begin, place, sorted.end());
    source.push_back(*place);
    begin = place;
  }
  for (float& value : values) {
    const auto above = std::upper_bound(source.begin() + 1, source.end() - 1, value);
    const auto i = static_cast<std::size_t>(above - source.begin());
    const float width = source[i] - source[i - 1];
    const float share = width > 0 ? (value - source[i - 1]) / width : 0;
    value = std::lerp(knots[i - 1].value, knots[i].value, std::clamp(share, 0.0f, 1.0f));
  }
}

}  // namespace patina
