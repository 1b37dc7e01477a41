#include "gui/window/opening_screen.h"

#include <imgui.h>

#include <cmath>
#include <utility>

#include "gui/window/layout.h"
#include "gui/window/look.h"
#include "gui/window/theme.h"

namespace patina {
namespace {

constexpr double kInterval = 0.05;  // seconds between frames: the explorer is loading on the other core

void draw_empty_panel(const Rect& place, const char* title, ImFont* font) {
  // Where Dear ImGui puts a window.
  const Rect rect{{std::floor(place.position.x), std::floor(place.position.y)},
                  {std::floor(place.size.x), std::floor(place.size.y)}};
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImGuiStyle& style = ImGui::GetStyle();
  list.AddRectFilled(rect.position, {rect.position.x + rect.size.x, rect.position.y + rect.size.y},
                     theme::kPanel, style.WindowRounding);
  list.AddText(font, ImGui::GetFontSize(),
               {rect.position.x + style.WindowPadding.x, rect.position.y + style.WindowPadding.y},
               theme::kText, title);
}

}  // namespace

OpeningScreen::OpeningScreen(Window& window, const Preferences& preferences, std::string input)
    : window_(window),
      shares_(preferences.shares),
      input_(std::move(input)),
      fonts_(dress(window, preferences)) {}

void OpeningScreen::frame() {
  window_.begin_frame(kInterval);
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const float em = ImGui::GetFontSize();
  const Layout layout = lay_out(size, shares_, em);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddRectFilled({0, 0}, size, theme::kWindow);
  list.AddText(fonts_.semibold, em, {em, 0.5f * (layout.top_bar.size.y - em)}, theme::kAccent, "Patina");
  const std::pair<const Rect&, const char*> panels[] = {
      {layout.photo, "Photo"},       {layout.preview, "Render"}, {layout.scatter, "Draws"},
      {layout.material, "Material"}, {layout.chains, "Chains"},  {layout.draw, ""}};
  for (const auto& [rect, title] : panels) draw_empty_panel(rect, title, fonts_.semibold);
  const std::string text = input_.empty() ? "Getting ready..." : "Opening " + input_ + "...";
  const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
  const Rect& middle = layout.scatter;
  list.AddText({middle.position.x + 0.5f * (middle.size.x - extent.x),
                middle.position.y + 0.5f * (middle.size.y - extent.y)},
               theme::kMuted, text.c_str());
  window_.end_frame();
}

}  // namespace patina
