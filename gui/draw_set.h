#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace patina {

/// A set of draws, by their indices. A value; copies share what they hold, so that undo may keep many.
class DrawSet {
 public:
  DrawSet() = default;  ///< no draw

  /// Those of the draws [0, count) for which `belongs(draw)` holds.
  template <typename Predicate>
  static DrawSet of(std::size_t count, Predicate belongs) {
    std::vector<bool> members(count);
    std::size_t size = 0;
    for (std::size_t draw = 0; draw < count; ++draw) {
      members[draw] = belongs(draw);
      size += members[draw] ? 1 : 0;
    }
    return DrawSet(std::move(members), size);
  }

  bool contains(std::size_t draw) const { return members_ && draw < members_->size() && (*members_)[draw]; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  DrawSet with(const DrawSet& other) const;
  DrawSet without(const DrawSet& other) const;

  bool operator==(const DrawSet& other) const;  ///< whether the same draws belong to both

 private:
  DrawSet(std::vector<bool> members, std::size_t size);
  std::size_t bound() const { return members_ ? members_->size() : 0; }

  std::shared_ptr<const std::vector<bool>> members_;  ///< null where there are none
  std::size_t size_ = 0;
};

}  // namespace patina
