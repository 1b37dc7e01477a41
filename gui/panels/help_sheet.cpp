#include "gui/panels/help_sheet.h"

#include <array>
#include <utility>

#include "gui/theme.h"

namespace patina {
namespace {

using Line = std::pair<const char*, const char*>;

constexpr std::array<Line, 18> kKeys{
    {{"Drop a file", "Open a photo, or a run's directory"},
     {"Ctrl+O", "Open a photo or a run"},
     {"Space", "Pause or resume the run"},
     {"Left, right", "Next better, next less likely draw"},
     {"Esc", "Let go of the marked draws, then of the selected one; dismiss a message"},
     {"Ctrl+Z, Ctrl+Y", "Undo, redo"},
     {"Ctrl+E", "Export the draw that is shown"},
     {"S", "Star the draw that is shown, or take its star away"},
     {"P, A, T, G", "One plot, all pairs, trace, gallery"},
     {"B, L", "Mark draws by dragging a box, or a line around them"},
     {"K", "Contours around half of the draws, and nine in ten"},
     {"M", "What the marked draws range over"},
     {"?", "This sheet"},
     {"Click in the plot", "Select the nearest draw; its render appears"},
     {"Drag in the plot", "Mark draws in every plot; Shift adds, Ctrl takes away"},
     {"Wheel, right drag", "Zoom and move the plot"},
     {"Double click", "Show all draws again"},
     {"Drag in the render", "Wipe between photo and render"}}};

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
  ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed, 10 * ImGui::GetFontSize());
  ImGui::TableSetupColumn("does", ImGuiTableColumnFlags_WidthFixed, 28 * ImGui::GetFontSize());
  for (const auto& [what, does] : lines) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(what);
    ImGui::TableNextColumn();
    muted_text(does);
  }
  ImGui::EndTable();
}

}  // namespace

void draw_help_sheet(const PanelContext& context, bool& open) {
  constexpr const char* kName = "Help##sheet";
  if (open && !ImGui::IsPopupOpen(kName)) ImGui::OpenPopup(kName);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Always, {0.5f, 0.5f});
  if (!ImGui::BeginPopupModal(kName, nullptr,
                              ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_AlwaysAutoResize))
    return;
  heading_text(context, "Mouse and keys");
  draw_lines("keys", kKeys);
  ImGui::Spacing();
  heading_text(context, "Words");
  draw_lines("words", kWords);
  ImGui::Spacing();
  if (ImGui::Button("Close")) open = false;
  if (!open) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace patina
