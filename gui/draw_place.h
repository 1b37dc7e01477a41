#pragma once

#include <compare>
#include <cstdint>

namespace patina {

/// A draw by its place in its chain, which stays the same however often a run is opened.
struct DrawPlace {
  int chain = 0;
  std::int64_t iteration = 0;
  auto operator<=>(const DrawPlace&) const = default;
};

}  // namespace patina
