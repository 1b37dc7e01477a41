#include "gui/gl/opaque_fills.h"

namespace patina {

std::optional<OpaqueFill> opaque_fill(const ImDrawList& list, const ImDrawCmd& command, unsigned first,
                                      ImVec2 white_pixel) {
  const auto vertex = [&](unsigned i) -> const ImDrawVert& {
    return list.VtxBuffer[static_cast<int>(command.VtxOffset + list.IdxBuffer[static_cast<int>(first + i)])];
  };
  const ImDrawVert &a = vertex(0), &b = vertex(1), &c = vertex(2), &d = vertex(5);
  if ((a.col & IM_COL32_A_MASK) != IM_COL32_A_MASK) return std::nullopt;
  for (const ImDrawVert* v : {&a, &b, &c, &d})
    if (v->col != a.col || v->uv.x != white_pixel.x || v->uv.y != white_pixel.y) return std::nullopt;
  const bool halves_share_a_diagonal = &vertex(3) == &a && &vertex(4) == &c;
  const bool upright = a.pos.y == b.pos.y && b.pos.x == c.pos.x && c.pos.y == d.pos.y && d.pos.x == a.pos.x;
  if (!halves_share_a_diagonal || !upright || !(a.pos.x < c.pos.x && a.pos.y < c.pos.y)) return std::nullopt;
  return OpaqueFill{a.pos, c.pos, a.col};
}

}  // namespace patina
