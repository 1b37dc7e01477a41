#include "gui/panels/panel.h"

#include <imgui_internal.h>  // that keys pass an item over

#include <algorithm>
#include <cmath>

#include "gui/window/theme.h"

namespace patina {
namespace {

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;

float text_width(const std::string& text) {
  return ImGui::CalcTextSize(text.data(), text.data() + text.size()).x;
}

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

/// Cuts UTF-8 text in the middle until it fits.
std::string elided(const std::string& text, float width) {
  static const std::string kDots = "\u2026";
  std::size_t head = text.size() / 2, tail = text.size() - head;
  while (head > 0 && tail > 0) {
    --head, --tail;
    while (head > 0 && continues_character(text[head])) --head;
    while (tail > 0 && continues_character(text[text.size() - tail])) --tail;
    std::string cut = text.substr(0, head) + kDots + text.substr(text.size() - tail);
    if (text_width(cut) <= width) return cut;
  }
  return kDots;
}

/// Between two rounded ends plain rectangles, which the renderer fills at once.
void draw_ground(const Rect& rect) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const float round = std::ceil(ImGui::GetStyle().WindowRounding);
  const ImVec2 low = rect.position, high{low.x + rect.size.x, low.y + rect.size.y};
  list.AddRectFilled(low, {high.x, low.y + round}, theme::kPanel, round, ImDrawFlags_RoundCornersTop);
  list.AddRectFilled({low.x, low.y + round}, {high.x, high.y - round}, theme::kPanel);
  list.AddRectFilled({low.x, high.y - round}, high, theme::kPanel, round, ImDrawFlags_RoundCornersBottom);
}

}  // namespace

PanelScope::PanelScope(const char* title, const Rect& rect, const PanelContext& context,
                       ImGuiWindowFlags flags) {
  ImGui::SetNextWindowPos(rect.position);
  ImGui::SetNextWindowSize(rect.size);
  draw_ground(rect);
  ImGui::Begin(title, nullptr, kFixed | ImGuiWindowFlags_NoBackground | flags);
  const std::string text = title;
  heading_text(context, text.substr(0, text.find("##")));
}

PanelScope::~PanelScope() { ImGui::End(); }

bool begin_box(const char* name, bool visible, ImVec2 em) {
  if (visible && !ImGui::IsPopupOpen(name)) ImGui::OpenPopup(name);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float unit = ImGui::GetFontSize();
  ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize(
      {std::min(em.x * unit, display.x - 2 * unit), std::min(em.y * unit, display.y - 2 * unit)});
  return ImGui::BeginPopupModal(
      name, nullptr, ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove);
}

void heading_text(const PanelContext& context, const std::string& text) {
  ImGui::PushFont(context.heading);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopFont();
}

void muted_text(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, theme::kMuted);
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

void elided_text(const std::string& text, float width, ImU32 color) {
  const bool fits = text_width(text) <= width;
  elided_text(text, width, color, fits ? "" : text);
}

void elided_text(const std::string& text, float width, ImU32 color, const std::string& more) {
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  ImGui::TextUnformatted(text_width(text) <= width ? text.c_str() : elided(text, width).c_str());
  ImGui::PopStyleColor();
  if (!more.empty()) tooltip(more);
}

bool mouse_rests_after_click() {
  const ImGuiIO& io = ImGui::GetIO();
  const ImVec2 clicked = io.MouseClickedPos[ImGuiMouseButton_Left];
  const float x = io.MousePos.x - clicked.x, y = io.MousePos.y - clicked.y;
  return x * x + y * y < io.MouseDragThreshold * io.MouseDragThreshold;
}

void tooltip(const std::string& text) {
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) || mouse_rests_after_click()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(26 * ImGui::GetFontSize());
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool primary_button(const char* label, ImVec2 size) {
  ImGui::PushStyleColor(ImGuiCol_Button, theme::kAccent);
  ImGui::PushStyleColor(ImGuiCol_ButtonHovered, theme::kAccentHovered);
  ImGui::PushStyleColor(ImGuiCol_ButtonActive, theme::kAccentActive);
  ImGui::PushStyleColor(ImGuiCol_Text, theme::kOnAccent);
  const bool pressed = ImGui::Button(label, size);
  ImGui::PopStyleColor(4);
  return pressed;
}

bool picture_button(const char* id, ImVec2 size) {
  const bool pressed = ImGui::InvisibleButton(id, size);
  if (ImGui::IsItemFocused() && ImGui::GetIO().NavVisible)
    ImGui::GetWindowDrawList()->AddRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), theme::kAccent,
                                        ImGui::GetStyle().FrameRounding, 0, 2);
  return pressed;
}

void mouse_area(const char* id, ImVec2 size, ImGuiButtonFlags buttons) {
  ImGui::PushItemFlag(ImGuiItemFlags_NoNav, true);
  ImGui::InvisibleButton(id, size, buttons);
  ImGui::PopItemFlag();
}

bool toggle_button(const char* label, bool on) {
  ImGui::PushStyleColor(ImGuiCol_Button, on ? ImGui::GetColorU32(ImGuiCol_Button) : IM_COL32(0, 0, 0, 0));
  ImGui::PushStyleColor(ImGuiCol_Text, on ? theme::kText : theme::kMuted);
  const bool pressed = ImGui::Button(label);
  ImGui::PopStyleColor(2);
  return pressed;
}

void align_right(float width) {
  ImGui::SameLine();
  ImGui::SetCursorPosX(std::max(ImGui::GetCursorPosX(), ImGui::GetContentRegionMax().x - width));
}

void draw_resolution_choice(const char* label, std::initializer_list<int> choices, int& resolution) {
  const auto text = [](int pixels) { return std::to_string(pixels) + " px"; };
  if (!ImGui::BeginCombo(label, text(resolution).c_str())) return;
  for (const int choice : choices) {
    if (ImGui::Selectable(text(choice).c_str(), choice == resolution)) resolution = choice;
  }
  ImGui::EndCombo();
}

Rect centred_square(const Rect& rect) {
  const float side = std::floor(std::min(rect.size.x, rect.size.y));
  return {{std::floor(rect.position.x + 0.5f * (rect.size.x - side)),
           std::floor(rect.position.y + 0.5f * (rect.size.y - side))},
          {side, side}};
}

void centred_hint(const Rect& rect, const std::string& text) {
  const float wrap = 0.8f * rect.size.x;
  const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
  const ImVec2 corner{rect.position.x + 0.5f * (rect.size.x - size.x),
                      rect.position.y + 0.5f * (rect.size.y - size.y)};
  ImGui::GetWindowDrawList()->AddText(nullptr, 0, corner, theme::kMuted, text.c_str(), nullptr, wrap);
}

float button_width(const char* label) {
  return ImGui::CalcTextSize(label, nullptr, true).x + 2 * ImGui::GetStyle().FramePadding.x;
}

}  // namespace patina
