#include "gui/window/layout.h"

#include <algorithm>

namespace patina {
namespace {

constexpr float kGap = 0.5f;      // em
constexpr float kTopBar = 3.0f;   // em
constexpr float kChains = 16.0f;  // em
constexpr float kDraw = 8.2f;     // em

/// The right column's tables need their room even in a small window.
float right_width(ImVec2 size, const ColumnShares& shares, float em) {
  return std::max(shares.right * size.x, std::min(25 * em, 0.42f * size.x));
}

void drag_gap(const char* name, float x, ImVec2 size, float em, float sign, float& share) {
  ImGui::SetNextWindowPos({x - 0.5f * kGap * em, kTopBar * em});
  ImGui::SetNextWindowSize({kGap * em, size.y - kTopBar * em});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::Begin(name, nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav);
  ImGui::InvisibleButton("gap", ImGui::GetWindowSize());
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (ImGui::IsItemActive())
    share = std::clamp(share + sign * ImGui::GetIO().MouseDelta.x / size.x, 0.18f, 0.40f);
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace

Layout lay_out(ImVec2 size, const ColumnShares& shares, float em) {
  const float gap = kGap * em, top = kTopBar * em;
  const float body = size.y - top - gap;
  const float left = shares.left * size.x, right = right_width(size, shares, em);
  const float middle = size.x - left - right - 4 * gap;
  const float half = 0.5f * (body - gap);
  const float x_middle = 2 * gap + left, x_right = x_middle + middle + gap;
  const float material = body - (kChains + kDraw) * em - 2 * gap;

  Layout layout;
  layout.top_bar = {{0, 0}, {size.x, top}};
  layout.photo = {{gap, top}, {left, half}};
  layout.preview = {{gap, top + half + gap}, {left, half}};
  layout.scatter = {{x_middle, top}, {middle, body}};
  layout.material = {{x_right, top}, {right, material}};
  layout.chains = {{x_right, top + material + gap}, {right, kChains * em}};
  layout.draw = {{x_right, top + material + kChains * em + 2 * gap}, {right, kDraw * em}};
  return layout;
}

void drag_columns(ImVec2 size, float em, ColumnShares& shares) {
  const float gap = kGap * em;
  drag_gap("##left gap", 1.5f * gap + shares.left * size.x, size, em, 1, shares.left);
  drag_gap("##right gap", size.x - 1.5f * gap - right_width(size, shares, em), size, em, -1, shares.right);
}

}  // namespace patina
