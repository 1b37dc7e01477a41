#include "gui/panels/material_panel.h"

#include "engine/material/registry.h"
#include "gui/advice.h"
#include "gui/window/theme.h"
#include "gui/words.h"

namespace patina {

MaterialPanel::MaterialPanel() : materials_(material_names()) {}

void MaterialPanel::draw(const PanelContext& context, const Rect& rect, const ShownDraw& shown) {
  const PanelScope panel("Material", rect, context, ImGuiWindowFlags_NoScrollbar);
  draw_choices(context);
  hint_.draw(context);
  draw_start(context, shown);
  draw_advice(context);
  ImGui::Spacing();
  table_.draw(context, shown);
}

void MaterialPanel::draw_choices(const PanelContext& context) {
  Session& session = context.session;
  const float gap = ImGui::GetStyle().ItemSpacing.x, half = 0.5f * (ImGui::GetContentRegionAvail().x - gap);
  ImGui::SetNextItemWidth(half);
  if (ImGui::BeginCombo("##material", capitalised(session.settings().material).c_str())) {
    const bool can_find = session.has_photo() && session.photo_is_current();
    if (ImGui::Selectable("Auto: find out which", false, can_find ? 0 : ImGuiSelectableFlags_Disabled))
      context.commands.push_back([&session] { session.find_material(); });
    tooltip(
        "Tries all materials on the photo and says how likely each is. Takes a moment, and is a hint: you "
        "choose.");
    for (const std::string& name : materials_) {
      if (ImGui::Selectable(capitalised(name).c_str(), name == session.settings().material)) {
        context.commands.push_back([&session, name] { session.choices().set_material(name); });
      }
      if (name == session.settings().material) ImGui::SetItemDefaultFocus();
    }
    ImGui::EndCombo();
  }
  tooltip(session.choices().material().description + "\nThe material that the next run fits to the photo.");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(half);
  double size = session.settings().capture.size_cm;
  if (ImGui::InputDouble("##size", &size, 0, 0, "%.2f cm wide", ImGuiInputTextFlags_EnterReturnsTrue) &&
      size >= 0.1 && size <= 1000) {
    context.commands.push_back([&session, size] { session.choices().set_size_cm(size); });
  }
  tooltip(
      "How wide the photographed square is, from 0.1 to 1000 cm. Type it and press Enter; the next run takes "
      "it.");
}

void MaterialPanel::draw_start(const PanelContext& context, const ShownDraw& shown) {
  Session& session = context.session;
  ImGui::BeginDisabled(!session.has_photo() || !session.photo_is_current());
  const float room = ImGui::GetContentRegionAvail().x, gap = ImGui::GetStyle().ItemSpacing.x;
  if (session.choices_wait()) {
    const bool can_go_on = session.run_is_of_choice() && shown.kind != ShownDraw::Kind::typical;
    if (primary_button("Start afresh", {can_go_on ? 0.5f * (room - gap) : room, 0}))
      context.commands.push_back([&session] { session.start(); });
    tooltip(
        "What you changed takes effect in the next run, which this starts in a directory of its own; the "
        "draws "
        "of this one stay on disk.");
    if (can_go_on) {
      ImGui::SameLine();
      if (ImGui::Button("Go on from here", {-1, 0}))
        context.commands.push_back([&session, values = shown.values] { session.start_at(values); });
      tooltip("Starts the next run, too, with its chains at the draw that is shown.");
    }
  } else if (session.has_run()) {
    if (ImGui::Button("Start again with these settings", {room, 0}))
      context.commands.push_back([&session] { session.start(); });
    tooltip("Starts a new run in a directory of its own; the draws of this one stay on disk.");
  } else {
    if (primary_button("Start", {room, 0})) context.commands.push_back([&session] { session.start(); });
    tooltip(session.has_photo() ? "Looks for a good match, then draws samples around it."
                                : "Open a photo first.");
  }
  ImGui::EndDisabled();
}

void MaterialPanel::draw_advice(const PanelContext& context) {
  Session& session = context.session;
  const std::vector<ParameterAdvice> advice = advice_for_next_run(session);
  if (advice.empty()) return;
  std::string all;
  for (const ParameterAdvice& a : advice) all += (all.empty() ? "" : "\n") + advice_sentence(a);
  const std::map<std::string, double> held = frozen_by(advice);
  const char* hold = held.size() == 1 ? "Hold it and go on" : "Hold these and go on";
  const float room = ImGui::GetContentRegionAvail().x;
  ImGui::AlignTextToFramePadding();
  if (held.empty()) {
    elided_text(advice_title(advice.front()), room, theme::kMuted);
    return tooltip(all);
  }
  elided_text(holdable_text(advice), room - button_width(hold) - ImGui::GetStyle().ItemSpacing.x,
              theme::kWarning);
  tooltip(all);
  align_right(button_width(hold));
  if (ImGui::Button(hold)) context.commands.push_back([&session, held] { session.hold_and_go_on(held); });
  tooltip(all + "\n\nStarts the next run from the best match with " + (held.size() == 1 ? "this" : "these") +
          " held: less to infer, at nothing that this photo could tell. The draws of this run stay on disk. "
          "Choose another value by taste: select a draw and click the lock.");
}

}  // namespace patina
