#include "gui/draw_set.h"

#include <algorithm>
#include <utility>

namespace patina {

DrawSet::DrawSet(std::vector<bool> members, std::size_t size) : size_(size) {
  if (size > 0) members_ = std::make_shared<const std::vector<bool>>(std::move(members));
}

DrawSet DrawSet::with(const DrawSet& other) const {
  return of(std::max(bound(), other.bound()),
            [&](std::size_t draw) { return contains(draw) || other.contains(draw); });
}

DrawSet DrawSet::without(const DrawSet& other) const {
  return of(bound(), [&](std::size_t draw) { return contains(draw) && !other.contains(draw); });
}

bool DrawSet::operator==(const DrawSet& other) const {
  if (members_ == other.members_) return true;
  if (size_ != other.size_) return false;
  const std::size_t bound = std::max(this->bound(), other.bound());
  for (std::size_t draw = 0; draw < bound; ++draw) {
    if (contains(draw) != other.contains(draw)) return false;
  }
  return true;
}

}  // namespace patina
