#pragma once

#include <imgui.h>

namespace patina {

/// A rectangle of the window, in ImGui coordinates.
struct Rect {
  ImVec2 position{0, 0};
  ImVec2 size{0, 0};
};

/// How the window's width is shared; the scatter plot has what is left.
struct ColumnShares {
  float left = 0.27f;
  float right = 0.31f;
  bool operator==(const ColumnShares&) const = default;
};

/// Where every panel goes.
struct Layout {
  Rect top_bar, photo, preview, scatter, material, chains, draw;
};

/// @param size  of the window
/// @param em    the font's size, the unit of everything that is fixed
Layout lay_out(ImVec2 size, const ColumnShares& shares, float em);

/// The gaps between the columns, to be dragged. Changes the shares and keeps every column usable.
void drag_columns(ImVec2 size, float em, ColumnShares& shares);

}  // namespace patina
