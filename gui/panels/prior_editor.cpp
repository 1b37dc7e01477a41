#include "gui/panels/prior_editor.h"

#include "gui/panels/field_row.h"
#include "gui/window/theme.h"
#include "gui/words.h"

namespace patina {
namespace {

constexpr const char* kPriorPopup = "assumed";

}  // namespace

void PriorEditor::open(const std::string& parameter, ImVec2 point) {
  parameter_ = parameter;
  point_ = point;
  opens_ = true;
}

bool PriorEditor::edit(const char* label, double& value, double span, const char* what) {
  begin_field(label, what);
  const bool changed = ImGui::DragScalar(("##" + std::string(label)).c_str(), ImGuiDataType_Double, &value,
                                         static_cast<float>(span) / 300, nullptr, nullptr, "%.4g");
  if (ImGui::IsItemActivated()) new_gesture_ = true;
  tooltip(what);
  return changed;
}

void PriorEditor::draw_fields(const PanelContext& context, const Parameter& own, const Parameter& parameter) {
  TruncatedNormal prior = parameter.prior;
  const double span = own.prior.high - own.prior.low;
  if (!ImGui::BeginTable("fields", 2)) return;
  const float em = ImGui::GetFontSize();
  ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed, 5 * em);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthFixed, 8 * em);
  bool changed = edit("Middle", prior.mean, span, "The value that you would guess (mean)");
  changed |= edit("Spread", prior.sd, span,
                  "How sure you are: two values in three lie this close to the middle (standard deviation)");
  changed |= edit("Lowest", prior.low, span, "No value below this is tried");
  changed |= edit("Highest", prior.high, span, "No value above this is tried");
  ImGui::EndTable();
  fields_ = {ImGui::GetItemRectMin(), ImGui::GetItemRectSize()};
  if (!changed) return;
  RunChoices& choices = context.session.choices();
  context.commands.push_back(
      [&choices, name = own.name, prior, first = new_gesture_] { choices.set_prior(name, prior, first); });
  new_gesture_ = false;
}

void PriorEditor::draw(const PanelContext& context) {
  if (opens_) ImGui::OpenPopup(kPriorPopup);
  ImGui::SetNextWindowPos(point_, ImGuiCond_Always, {1, 0.3f});
  opens_ = false;
  if (!ImGui::BeginPopup(kPriorPopup)) return;
  RunChoices& choices = context.session.choices();
  const auto index = choices.material().find_continuous(parameter_);
  if (!index) {
    ImGui::CloseCurrentPopup();  // the material is another one by now
    ImGui::EndPopup();
    return;
  }
  const Parameter& own = choices.material().continuous[*index];
  const std::string unit = own.unit.empty() ? "" : " (" + own.unit + ")";
  heading_text(context, parameter_label(own.name) + unit);
  muted_text("Assumed before looking at the photo, for the next run");
  draw_fields(context, own, choices.table().continuous[*index]);
  ImGui::BeginDisabled(choices.table().continuous[*index].prior == own.prior);
  if (ImGui::Button("As the material has it"))
    context.commands.push_back([&choices, name = own.name] { choices.reset_prior(name); });
  ImGui::EndDisabled();
  align_right(button_width("Close"));
  if (ImGui::Button("Close")) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace patina
