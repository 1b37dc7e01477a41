#include "gui/panels/colour_legend.h"

#include <algorithm>
#include <string>
#include <vector>

#include "gui/panels/panel.h"
#include "gui/window/theme.h"
#include "gui/words.h"

namespace patina {
namespace {

constexpr int kMostDots = 8;  // more do not fit, and colours repeat

void draw_dots(const std::string& title, const std::vector<std::string>& names) {
  const float em = ImGui::GetFontSize();
  ImGui::TextDisabled("%s", title.c_str());
  for (std::size_t i = 0; i < names.size(); ++i) {
    ImGui::SameLine(0, 0.7f * em);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddCircleFilled({at.x + 0.3f * em, at.y + 0.55f * em}, 0.26f * em,
                                                theme::chain_color(static_cast<int>(i)));
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 0.75f * em);
    ImGui::TextDisabled("%s", names[i].c_str());
  }
}

void draw_scale(const ParameterTable& table, const DrawColours& colours) {
  constexpr int kSteps = 24;
  const float em = ImGui::GetFontSize(), width = 7 * em;
  const PlotAxis& axis = colours.colouring().axis;
  ImGui::TextDisabled("%s", tick_label(table, axis, colours.range().low).c_str());
  ImGui::SameLine(0, 0.4f * em);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float top = at.y + 0.25f * em, bottom = at.y + 0.85f * em;
  for (int i = 0; i < kSteps; ++i) {
    const auto x = [&](int step) { return at.x + width * static_cast<float>(step) / kSteps; };
    ImGui::GetWindowDrawList()->AddRectFilledMultiColor(
        {x(i), top}, {x(i + 1), bottom}, theme::ramp_color(1.0 * i / kSteps),
        theme::ramp_color((i + 1.0) / kSteps), theme::ramp_color((i + 1.0) / kSteps),
        theme::ramp_color(1.0 * i / kSteps));
  }
  ImGui::Dummy({width, ImGui::GetTextLineHeight()});
  tooltip("Nearly all draws lie between these two; those beyond have the colour of the nearer end.");
  ImGui::SameLine(0, 0.4f * em);
  ImGui::TextDisabled("%s", tick_label(table, axis, colours.range().high).c_str());
}

std::string colouring_label(const ParameterTable& table, const Colouring& colouring) {
  switch (colouring.kind) {
    case Colouring::Kind::automatic:
      return "Colours: automatic";
    case Colouring::Kind::density:
      return "How many draws";
    case Colouring::Kind::chain:
      return "Chain";
    case Colouring::Kind::axis:
      return axis_label(table, colouring.axis);
  }
  return {};
}

}  // namespace

void draw_colour_legend(const ExplorerModel& model, const DrawColours& colours, bool density) {
  const Colouring& colouring = colours.colouring();
  if (colours.is_scale()) return draw_scale(model.table(), colours);
  std::vector<std::string> names;
  if (colouring.kind == Colouring::Kind::axis) {
    const DiscreteParameter& choice = model.table().discrete[colouring.axis.index];
    for (const std::string& level : choice.levels) names.push_back(capitalised(level));
    if (names.size() > kMostDots) names.resize(kMostDots);
    return draw_dots(parameter_label(choice.name), names);
  }
  if (density && colouring.kind != Colouring::Kind::chain) {
    ImGui::TextDisabled("Brighter: more draws");
    return;
  }
  for (int chain = 1; chain <= std::min(model.draws().chain_count(), kMostDots); ++chain)
    names.push_back(std::to_string(chain));
  draw_dots("Chain", names);
}

bool choose_colouring(const char* id, float width, const ParameterTable& table, Colouring& colouring) {
  std::vector<Colouring> choices{
      {Colouring::Kind::automatic, {}}, {Colouring::Kind::density, {}}, {Colouring::Kind::chain, {}}};
  auto axes = plot_axes(table);
  std::rotate(axes.begin(), axes.end() - 1, axes.end());  // the match first
  for (const PlotAxis& axis : axes) choices.push_back({Colouring::Kind::axis, axis});
  ImGui::SetNextItemWidth(width);
  const std::string shown = colouring_label(table, colouring);
  if (!ImGui::BeginCombo(id, shown.c_str(), ImGuiComboFlags_HeightLarge)) {
    tooltip(
        "What the colour of a draw tells. Automatic: its chain, or how many draws there are where they "
        "cover each other.");
    return false;
  }
  bool changed = false;
  for (const Colouring& choice : choices) {
    if (ImGui::Selectable(colouring_label(table, choice).c_str(), choice == colouring)) {
      colouring = choice;
      changed = true;
    }
  }
  ImGui::EndCombo();
  return changed;
}

}  // namespace patina
