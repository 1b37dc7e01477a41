#pragma once

#include <imgui.h>

#include <optional>

namespace patina {

/// A rectangle of one opaque colour.
struct OpaqueFill {
  ImVec2 low, high;
  ImU32 color = 0;

  float area() const { return (high.x - low.x) * (high.y - low.y); }
};

/// The fill that the six indices of a draw list from `first` on are, as ImDrawList::PrimRect() lays one out;
/// nothing if they are anything else. Such a fill can be cleared to, which a software rasteriser does many
/// times faster than it samples and blends.
std::optional<OpaqueFill> opaque_fill(const ImDrawList& list, const ImDrawCmd& command, unsigned first,
                                      ImVec2 white_pixel);

}  // namespace patina
