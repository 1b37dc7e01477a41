#include "gui/panels/marginal_bars.h"

#include <algorithm>

#include "gui/window/theme.h"

namespace patina {
namespace {

constexpr ImU32 kBar = IM_COL32(150, 154, 158, 110);

/// Calls fill(first, last, height, color) for every bar: where it lies as shares of the range, and its height
/// as a share of the highest.
template <typename Fill>
void each_bar(const Histogram& bars, Fill fill) {
  const auto share = [](auto part, auto whole) {
    return static_cast<float>(part) / static_cast<float>(whole);
  };
  const std::uint32_t peak = std::max(bars.peak(), 1u);
  for (int bin = 0; bin < bars.bins(); ++bin) {
    const float first = share(bin, bars.bins()), last = share(bin + 1, bars.bins());
    if (bars.all(bin) > 0) fill(first, last, share(bars.all(bin), peak), kBar);
    if (bars.marked(bin) > 0) fill(first, last, share(bars.marked(bin), peak), theme::kAccent);
  }
}

}  // namespace

void draw_bars_above(const PlotView& view, const Histogram& bars, float room) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  each_bar(bars, [&](float first, float last, float height, ImU32 color) {
    list.AddRectFilled({view.left + first * view.width, view.top - 1 - height * room},
                       {view.left + last * view.width, view.top - 1}, color);
  });
}

void draw_bars_beside(const PlotView& view, const Histogram& bars, float room) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float left = view.left + view.width + 1, bottom = view.top + view.height;
  each_bar(bars, [&](float first, float last, float height, ImU32 color) {
    list.AddRectFilled({left, bottom - last * view.height},
                       {left + height * room, bottom - first * view.height}, color);
  });
}

}  // namespace patina
