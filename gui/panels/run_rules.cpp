#include "gui/panels/run_rules.h"

#include "gui/panels/field_row.h"

namespace patina {
namespace {

constexpr const char* kButton = "Rules...";

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

/// @return whether another one was chosen
bool edit_errors(std::string& errors) {
  const std::string before = errors;
  const auto offer = [&](const char* name, const char* label, const char* what) {
    if (ImGui::RadioButton(label, errors == name)) errors = name;
    tooltip(what);
  };
  offer("auto", "As the material needs",
        "Averaged over irregularities where a material has grain (leather, plaster, wood, flake), else as "
        "usual");
  offer(
      "paper", "As usual between renders and photos",
      "Set by hand. The best match is searched for, and the render looks most like the photo; the intervals "
      "are as wide as such matches usually need");
  offer("averaged", "Averaged over irregularities",
        "As usual, and wider where other grain of the same material changes what is compared: a photo's own "
        "nobody knows. Some three thousand renders with grains of their own tell what a match looks like "
        "whatever its grain. Draws of leather, plaster and wood agree within a minute or two");
  offer(
      "calibrated", "Learnt from simulated photos",
      "A few hundred photos are simulated in place of a search: they tell how much a material's "
      "irregularities matter. For a photo that the material cannot quite make the best match is searched for "
      "as well, and photos are simulated about it. Then ten thousand draws come at once. Of simulated photos "
      "intervals of 90 % hold the truth in nine cases of ten; real photos are another matter, and renders "
      "look less like them");
  return errors != before;
}

}  // namespace

float run_rules_width() { return button_width(kButton); }

void draw_run_rules(const PanelContext& context) {
  constexpr const char* kName = "rules of the run";
  if (ImGui::Button(kButton)) ImGui::OpenPopup(kName);
  tooltip("When a run ends by itself, and what its intervals mean");
  if (!ImGui::BeginPopup(kName)) return;
  RunChoices& choices = context.session.choices();
  heading_text(context, "A run ends by itself");
  muted_text(
      "when its draws are this good, or its time is over. Type and press Enter; the next run takes it.");
  StopRules rules = choices.settings().stop;
  if (edit_rules(rules)) context.commands.push_back([&choices, rules] { choices.set_stop_rules(rules); });
  ImGui::Spacing();
  heading_text(context, "How far off a render may be");
  std::string errors = choices.settings().errors;
  if (edit_errors(errors)) context.commands.push_back([&choices, errors] { choices.set_errors(errors); });
  ImGui::EndPopup();
}

}  // namespace patina
