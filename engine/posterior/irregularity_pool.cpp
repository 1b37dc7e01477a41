#include "engine/posterior/irregularity_pool.h"

#include <algorithm>

namespace patina {

std::shared_ptr<IrregularityPool> make_pool(const ParameterTable& table, std::uint64_t first_seed,
                                            std::size_t most) {
  constexpr std::size_t kWithPlaces = 16;
  const bool places = std::ranges::count(table.continuous, true, &Parameter::place) > 0;
  const bool jagged = std::ranges::count(table.continuous, true, &Parameter::jagged) > 0;
  return std::make_shared<IrregularityPool>(first_seed, places ? kWithPlaces : jagged ? most : 0);
}

}  // namespace patina
