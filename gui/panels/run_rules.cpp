#include "gui/panels/stop_rules.h"

#include "gui/panels/field_row.h"

namespace patina {
namespace {

constexpr const char* kButton = "Stop when...";

/// @return whether another value was typed
bool edit(const char* label, const char* format, const char* what, double& value) {
  begin_field(label, what);
  const bool changed = ImGui::InputDouble(("##" + std::string(label)).c_str(), &value, 0, 0, format,
                                          ImGuiInputTextFlags_EnterReturnsTrue);
  tooltip(what);
  return changed;
}

bool edit_rules(StopRules& rules) {
  const float em = ImGui::GetFontSize();
  if (!ImGui::BeginTable("rules", 2)) return false;
  ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed, 10 * em);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthFixed, 6 * em);
  bool changed =
      edit("Independent draws", "%.0f",
           "Of every parameter that the photo pins down (ESS). 400 is the usual demand; 0: not asked for",
           rules.ess);
  changed |= edit("R-hat at most", "%.3f",
                  "How far the chains must agree on all of these. 1.01 is the usual demand; 0: not asked for",
                  rules.rhat);
  changed |=
      edit("Minutes at most", "%.1f", "However good the draws are by then; 0: no limit", rules.minutes);
  ImGui::EndTable();
  return changed;
}

}  // namespace

float stop_rules_width() { return button_width(kButton); }

void draw_stop_rules(const PanelContext& context) {
  constexpr const char* kName = "stop rules";
  if (ImGui::Button(kButton)) ImGui::OpenPopup(kName);
  tooltip("When a run ends by itself");
  if (!ImGui::BeginPopup(kName)) return;
  RunChoices& choices = context.session.choices();
  heading_text(context, "A run ends by itself");
  muted_text(
      "when its draws are this good, or its time is over. Type and press Enter; the next run takes it.");
  StopRules rules = choices.settings().stop;
  if (edit_rules(rules)) context.commands.push_back([&choices, rules] { choices.set_stop_rules(rules); });
  ImGui::EndPopup();
}

}  // namespace patina
