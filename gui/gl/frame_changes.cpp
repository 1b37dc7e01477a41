#include "gui/gl/frame_changes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace patina {
namespace {

constexpr int kTile = 32;               // pixels
constexpr std::size_t kMostRects = 16;  // each costs some draw calls

void mix(std::uint64_t& hash, std::uint64_t value) {
  hash = (std::rotl(hash, 23) ^ value) * 0x9e37'79b9'7f4a'7c15;
}

std::uint64_t hash_of(const void* bytes, std::size_t count) {
  std::uint64_t hash = count;
  for (std::size_t i = 0; i < count; i += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, static_cast<const char*>(bytes) + i, std::min(sizeof(word), count - i));
    mix(hash, word);
  }
  return hash;
}

struct Grid {
  int columns, rows;
  explicit Grid(const PixelRect& frame)
      : columns((frame.width + kTile - 1) / kTile), rows((frame.height + kTile - 1) / kTile) {}
  std::size_t size() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
};

/// What a frame draws in each tile.
class TileHashes {
 public:
  TileHashes(const ImDrawData& data, const std::vector<TriangleRects>& triangles, const PixelRect& frame)
      : data_(data), frame_(frame), grid_(frame), hashes_(grid_.size(), 0) {
    for (int n = 0; n < data.CmdListsCount; ++n) {
      const ImDrawList& list = *data.CmdLists[n];
      corners_.clear();
      for (const ImDrawVert& corner : list.VtxBuffer) corners_.push_back(hash_of(&corner, sizeof(corner)));
      for (const ImDrawCmd& command : list.CmdBuffer)
        add(list, command, triangles[static_cast<std::size_t>(n)]);
    }
  }
  std::vector<std::uint64_t> take() { return std::move(hashes_); }

 private:
  void add(const ImDrawList& list, const ImDrawCmd& command, const TriangleRects& triangles) {
    // A change of how what follows is blended concerns every tile.
    if (command.UserCallback) return add(frame_, std::bit_cast<std::uintptr_t>(command.UserCallback));
    const PixelRect clip = common_part(clip_of(data_, command), frame_);
    if (clip.empty()) return;
    std::uint64_t state = hash_of(&clip, sizeof(clip));
    mix(state, std::bit_cast<std::uintptr_t>(command.GetTexID()));
    const std::uint64_t* corners = corners_.data() + command.VtxOffset;
    for (unsigned i = command.IdxOffset; i + 3 <= command.IdxOffset + command.ElemCount; i += 3) {
      std::uint64_t triangle = state;
      for (unsigned k = i; k < i + 3; ++k) mix(triangle, corners[list.IdxBuffer.Data[k]]);
      add(common_part(triangles[i / 3], clip), triangle);
    }
  }

  void add(const PixelRect& where, std::uint64_t what) {
    if (where.empty()) return;
    const int last_column = (where.left + where.width - 1) / kTile;
    const int last_row = (where.top + where.height - 1) / kTile;
    for (int row = where.top / kTile; row <= last_row; ++row)
      for (int column = where.left / kTile; column <= last_column; ++column)
        mix(hashes_[static_cast<std::size_t>(row * grid_.columns + column)], what);
  }

  const ImDrawData& data_;
  PixelRect frame_;
  Grid grid_;
  std::vector<std::uint64_t> hashes_;
  std::vector<std::uint64_t> corners_;  ///< hashes of the vertices of the list that is added
};

/// Adds a rectangle, with those that it meets in one that holds them all.
void add_disjoint(std::vector<PixelRect>& rects, PixelRect added) {
  for (std::size_t i = 0; i < rects.size();) {
    if (common_part(rects[i], added).empty()) {
      ++i;
      continue;
    }
    added = spanned(rects[i], added);
    rects.erase(rects.begin() + static_cast<std::ptrdiff_t>(i));
    i = 0;
  }
  rects.push_back(added);
}

std::int64_t area(const PixelRect& rect) { return std::int64_t{rect.width} * rect.height; }

/// Joins the two that make the least of a rectangle more than they are themselves.
void join_nearest(std::vector<PixelRect>& rects) {
  std::pair<std::size_t, std::size_t> best{0, 1};
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  for (std::size_t a = 0; a < rects.size(); ++a) {
    for (std::size_t b = a + 1; b < rects.size(); ++b) {
      const std::int64_t more = area(spanned(rects[a], rects[b])) - area(rects[a]) - area(rects[b]);
      if (more >= least) continue;
      least = more;
      best = {a, b};
    }
  }
  const PixelRect both = spanned(rects[best.first], rects[best.second]);
  rects.erase(rects.begin() + static_cast<std::ptrdiff_t>(best.second));
  rects.erase(rects.begin() + static_cast<std::ptrdiff_t>(best.first));
  add_disjoint(rects, both);
}

/// Runs of changed tiles in a row, those of equal extent in neighbouring rows as one.
std::vector<PixelRect> runs_of(const std::vector<bool>& changed, const Grid& grid) {
  std::vector<PixelRect> runs;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns;) {
      int end = column;
      while (end < grid.columns && changed[static_cast<std::size_t>(row * grid.columns + end)]) ++end;
      if (end > column) {
        const PixelRect run{column * kTile, row * kTile, (end - column) * kTile, kTile};
        const auto above = std::ranges::find_if(runs, [&](const PixelRect& r) {
          return r.left == run.left && r.width == run.width && r.top + r.height == run.top;
        });
        if (above != runs.end())
          above->height += kTile;
        else
          runs.push_back(run);
      }
      column = end + 1;
    }
  }
  return runs;
}

}  // namespace

std::vector<PixelRect> FrameChanges::follow(const ImDrawData& data,
                                            const std::vector<TriangleRects>& triangles) {
  const PixelRect frame = frame_of(data);
  std::vector<std::uint64_t> before = std::exchange(tiles_, TileHashes(data, triangles, frame).take());
  if (std::exchange(frame_, frame) != frame || before.size() != tiles_.size()) return {frame};
  std::vector<bool> changed(tiles_.size());
  for (std::size_t i = 0; i < tiles_.size(); ++i) changed[i] = tiles_[i] != before[i];
  std::vector<PixelRect> rects = runs_of(changed, Grid(frame));
  while (rects.size() > kMostRects) join_nearest(rects);
  for (PixelRect& rect : rects) rect = common_part(rect, frame);
  return rects;
}

}  // namespace patina
