#include "gui/panels/material_panel.h"

#include "engine/material/registry.h"
#include "gui/theme.h"
#include "gui/words.h"

namespace patina {

MaterialPanel::MaterialPanel() : materials_(material_names()) {}

void MaterialPanel::draw(const PanelContext& context, const Rect& rect, const ShownDraw& shown) {
  const PanelScope panel("Material", rect, context, ImGuiWindowFlags_NoScrollbar);
  draw_choices(context);
  draw_start(context);
  ImGui::Spacing();
  table_.draw(context, shown);
}

void MaterialPanel::draw_choices(const PanelContext& context) {
  Session& session = context.session;
  const float gap = ImGui::GetStyle().ItemSpacing.x, half = 0.5f * (ImGui::GetContentRegionAvail().x - gap);
  ImGui::SetNextItemWidth(half);
  if (ImGui::BeginCombo("##material", capitalised(session.settings().material).c_str())) {
    for (const std::string& name : materials_) {
      if (ImGui::Selectable(capitalised(name).c_str(), name == session.settings().material)) {
        context.commands.push_back([&session, name] { session.choices().set_material(name); });
      }
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

void MaterialPanel::draw_start(const PanelContext& context) {
  Session& session = context.session;
  ImGui::BeginDisabled(!session.has_photo() || !session.photo_is_current());
  const ImVec2 size{ImGui::GetContentRegionAvail().x, 0};
  bool pressed = false;
  if (session.choices_wait()) {
    pressed = primary_button("Start afresh with your changes", size);
  } else if (session.has_run()) {
    pressed = ImGui::Button("Start again with these settings", size);
  } else {
    pressed = primary_button("Start", size);
  }
  ImGui::EndDisabled();
  tooltip(!session.has_photo() ? "Open a photo first."
          : session.choices_wait()
              ? "What you changed takes effect in the next run, which this starts in a directory of its own; "
                "the draws of this one stay on disk."
          : session.has_run()
              ? "Starts a new run in a directory of its own; the draws of this one stay on disk."
              : "Looks for a good match, then draws samples around it.");
  if (pressed) context.commands.push_back([&session] { session.start(); });
}

}  // namespace patina
