#include "gui/panels/material_hint.h"

#include <algorithm>
#include <utility>

#include "gui/ranking_view.h"
#include "gui/window/theme.h"
#include "gui/words.h"

namespace patina {
namespace {

constexpr const char* kResult = "how likely";
constexpr const char* kShow = "How likely...";

void draw_progress(const PanelContext& context) {
  Session& session = context.session;
  const MaterialFinder::Progress progress = session.finder().progress();
  const char* cancel = "Cancel";
  const std::string doing = progress.doing.empty() ? "Getting ready" : sentence(progress.doing);
  const float room =
      ImGui::GetContentRegionAvail().x - button_width(cancel) - ImGui::GetStyle().ItemSpacing.x;
  ImGui::AlignTextToFramePadding();
  elided_text(doing, room, theme::kAccent);
  tooltip("Tries all materials on the photo. A run that goes on meanwhile makes this slower.");
  align_right(button_width(cancel));
  if (ImGui::Button(cancel)) context.commands.push_back([&session] { session.finder().cancel(); });
  ImGui::PushStyleColor(ImGuiCol_PlotHistogram, theme::kAccent);
  ImGui::ProgressBar(static_cast<float>(progress.fraction), {-1, 0.35f * ImGui::GetFontSize()}, "");
  ImGui::PopStyleColor();
}

}  // namespace

void MaterialHint::draw(const PanelContext& context) {
  places_.clear();
  if (context.session.finder().busy()) return draw_progress(context);
  const MaterialRanking* ranking = context.session.hint();
  if (ranking == nullptr) return;
  const float room = ImGui::GetContentRegionAvail().x - button_width(kShow) - ImGui::GetStyle().ItemSpacing.x;
  ImGui::AlignTextToFramePadding();
  elided_text("A hint: " + ranking->sentence, room, theme::kMuted);
  align_right(button_width(kShow));
  const int shown = std::exchange(version_, context.session.hint_version());
  const bool is_awaited = shown != version_ && context.session.hint_was_asked_for();
  if (ImGui::Button(kShow) || is_awaited) ImGui::OpenPopup(kResult);
  const ImVec2 corner = ImGui::GetItemRectMax();
  ImGui::SetNextWindowPos({corner.x, corner.y + ImGui::GetStyle().ItemSpacing.y}, ImGuiCond_Appearing,
                          {1, 0});
  draw_result(context, *ranking);
}

/// A row to choose: the name, its share as a bar with words, and how well the best match fits.
void MaterialHint::draw_material(const PanelContext& context, const RankedMaterial& material) {
  Session& session = context.session;
  ImGui::TableNextColumn();
  const bool chosen = session.settings().material == material.material;
  if (ImGui::Selectable(capitalised(material.material).c_str(), chosen, ImGuiSelectableFlags_SpanAllColumns))
    context.commands.push_back(
        [&session, name = material.material] { session.choices().set_material(name); });
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  places_[material.material] = {0.5f * (low.x + high.x), 0.5f * (low.y + high.y)};
  ImGui::TableNextColumn();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float line = ImGui::GetTextLineHeight(), width = 6 * ImGui::GetFontSize();
  const float share = width * static_cast<float>(std::clamp(material.probability, 0.0, 1.0));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({corner.x, corner.y + 0.3f * line}, {corner.x + width, corner.y + 0.7f * line},
                     theme::kWell);
  list.AddRectFilled({corner.x, corner.y + 0.3f * line}, {corner.x + share, corner.y + 0.7f * line},
                     theme::kAccent);
  ImGui::Dummy({width, line});
  ImGui::SameLine();
  ImGui::TextUnformatted(likelihood_text(material).c_str());
  if (!material.misfit) return;
  ImGui::TableNextColumn();
  ImGui::PushStyleColor(ImGuiCol_Text, *material.misfit > kPoorMatch ? theme::kWarning : theme::kText);
  ImGui::TextUnformatted(fit_text(material).c_str());
  ImGui::PopStyleColor();
}

void MaterialHint::draw_result(const PanelContext& context, const MaterialRanking& ranking) {
  const float em = ImGui::GetFontSize();
  ImGui::SetNextWindowSize({33 * em, 0});
  if (!ImGui::BeginPopup(kResult)) return;
  heading_text(context, "Which material is it?");
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(sentence(ranking.sentence).c_str());
  ImGui::PopTextWrapPos();
  muted_text(uncertainty_text(ranking));
  ImGui::Spacing();
  const bool searched = ranking.materials.front().misfit.has_value();
  if (ImGui::BeginTable("materials", searched ? 3 : 2)) {
    ImGui::TableSetupColumn("Material", ImGuiTableColumnFlags_WidthFixed, 8 * em);
    ImGui::TableSetupColumn("Likely", ImGuiTableColumnFlags_WidthFixed, 15 * em);
    if (searched) ImGui::TableSetupColumn("Its best match", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableHeadersRow();
    for (const RankedMaterial& material : ranking.materials) draw_material(context, material);
    ImGui::EndTable();
  }
  muted_text("Click a material to choose it for the next run.");
  ImGui::EndPopup();
}

std::optional<ImVec2> MaterialHint::place_of(const std::string& material) const {
  const auto found = places_.find(material);
  return found != places_.end() ? std::optional(found->second) : std::nullopt;
}

}  // namespace patina
