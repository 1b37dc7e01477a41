#include "gui/panels/help_sheet.h"

#include <array>
#include <string>
#include <utility>

#include "gui/window/theme.h"

namespace patina {
namespace {

using Line = std::pair<const char*, const char*>;

constexpr std::array<Line, 10> kMouse{
    {{"Drop a file", "Open a photo, or a run's directory"},
     {"Click in the plot", "Select the nearest draw; its render appears"},
     {"Drag in the plot", "Mark draws in every plot; Shift adds, Ctrl takes away"},
     {"Wheel, right drag", "Zoom and move the plot"},
     {"Double click", "Show all draws again"},
     {"Drag on the photo", "Choose the square that is compared with the renders"},
     {"Drag on the render", "Wipe between photo and render"},
     {"On a lit shape", "The lamp follows the mouse; a right drag turns it, the wheel comes nearer"},
     {"Click a lock", "Hold a parameter at its value in the next run"},
     {"Click a curve", "Change what is assumed of a parameter"}}};

constexpr std::array<Line, 6> kWords{
    {{"Draw", "One material that could have made the photo. Many draws show what the photo leaves open."},
     {"Match",
      "How well a draw explains the photo, given what was assumed (log posterior); higher is better."},
     {"Chain",
      "An independent walk through the possible materials. Where chains agree, the answer can be trusted."},
     {"Warm-up", "The first steps of a chain, while it finds its way; not part of the answer."},
     {"R-hat", "How far the chains agree on a parameter: 1 is perfect, below 1.1 is usable."},
     {"ESS", "How many independent draws the chains are worth."}}};

template <std::size_t n>
void draw_lines(const char* name, const std::array<Line, n>& lines) {
  if (!ImGui::BeginTable(name, 2)) return;
  ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed, 9 * ImGui::GetFontSize());
  ImGui::TableSetupColumn("does", ImGuiTableColumnFlags_WidthStretch);
  for (const auto& [what, does] : lines) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(what);
    ImGui::TableNextColumn();
    muted_text(does);
  }
  ImGui::EndTable();
}

/// Every action that has a key, in the order of the list.
void draw_keys(const PanelContext& context, const std::vector<Action>& actions) {
  std::string group;
  for (const Action& action : actions) {
    if (action.shortcuts.empty()) continue;
    if (group != action.group) {
      if (!group.empty()) ImGui::Spacing();
      group = action.group;
      heading_text(context, group);
    }
    ImGui::TextUnformatted(shortcut_text(action).c_str());
    ImGui::SameLine(10.5f * ImGui::GetFontSize());
    ImGui::PushStyleColor(ImGuiCol_Text, theme::kMuted);
    ImGui::TextUnformatted(action.name.c_str());
    ImGui::PopStyleColor();
  }
}

}  // namespace

void draw_help_sheet(const PanelContext& context, const std::vector<Action>& actions, bool& open) {
  constexpr const char* kName = "Help##sheet";
  if (!begin_box(kName, open, {74, 50})) return;
  const float below = ImGui::GetFrameHeightWithSpacing(), half = 0.5f * ImGui::GetContentRegionAvail().x;
  ImGui::BeginChild("keys", {half, -below});
  draw_keys(context, actions);
  ImGui::EndChild();
  ImGui::SameLine();
  ImGui::BeginChild("mouse and words", {0, -below});
  heading_text(context, "Mouse");
  draw_lines("mouse", kMouse);
  ImGui::Spacing();
  heading_text(context, "Words");
  draw_lines("words", kWords);
  ImGui::EndChild();
  if (ImGui::Button("Close")) open = false;
  if (!open) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace patina
