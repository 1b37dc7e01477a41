#include "gui/panels/marked_draws.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "gui/panels/panel.h"
#include "gui/window/theme.h"
#include "gui/words.h"

namespace patina {
namespace {

/// The range of the whole answer as a track, that of the marked draws on it.
void draw_track(const PlotRange& whole, const PlotRange& part) {
  const float em = ImGui::GetFontSize(), width = 8 * em;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float middle = corner.y + 0.55f * em, half = 0.14f * em;
  const auto at = [&](double value) {
    const double share = whole.span() > 0 ? (value - whole.low) / whole.span() : 0.5;
    return corner.x + width * static_cast<float>(std::clamp(share, 0.0, 1.0));
  };
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({corner.x, middle - half}, {corner.x + width, middle + half}, theme::kLine, half);
  list.AddRectFilled({at(part.low), middle - half},
                     {std::max(at(part.high), at(part.low) + 2), middle + half}, theme::kAccent, half);
  ImGui::Dummy({width, em});
}

std::string range_text(const ParameterTable& table, const PlotAxis& axis, const PlotRange& range) {
  if (axis.kind != PlotAxis::Kind::discrete) return number_text(range.low) + " to " + number_text(range.high);
  const std::string low = tick_label(table, axis, std::round(range.low)),
                    high = tick_label(table, axis, std::round(range.high));
  return low == high ? low : low + " to " + high;
}

}  // namespace

void MarkedDraws::draw(ExplorerModel& model) {
  const DrawSet& marked = model.marked();
  if (marked.empty()) return;
  constexpr const char* kPopup = "marked";
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const std::string count = count_text(static_cast<long long>(marked.size())) + " marked";
  align_right(ImGui::CalcTextSize(count.c_str()).x + 2 * gap + button_width("Ranges") +
              button_width("Clear"));
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ImGui::GetStyle().FramePadding.x, 0});
  ImGui::PushStyleColor(ImGuiCol_Text, theme::kAccent);
  ImGui::TextUnformatted(count.c_str());
  ImGui::PopStyleColor();
  const double share = 100.0 * static_cast<double>(marked.size()) / static_cast<double>(model.draws().size());
  tooltip(number_text(share, 2) + " % of the draws; they stand out in every plot");
  ImGui::SameLine();
  if (ImGui::Button("Ranges")) ImGui::OpenPopup(kPopup);
  tooltip("What the parameters range over among the marked draws (M)");
  ImGui::SameLine();
  const bool cleared = ImGui::Button("Clear");
  tooltip("Mark no draws (Esc)");
  ImGui::PopStyleVar();
  const ImVec2 corner{ImGui::GetItemRectMax().x, ImGui::GetItemRectMax().y + 0.3f * ImGui::GetFontSize()};
  if (open_) ImGui::OpenPopup(kPopup);
  open_ = false;
  ImGui::SetNextWindowPos(corner, ImGuiCond_Always, {1, 0});
  if (ImGui::BeginPopup(kPopup)) {
    if (measured_ != marked) measure(model);
    draw_ranges(model);
    ImGui::EndPopup();
  }
  if (cleared) model.mark({}, Marking::replace);
}

void MarkedDraws::measure(const ExplorerModel& model) {
  measured_ = model.marked();
  ranges_.clear();
  for (const PlotAxis& axis : plot_axes(model.table()))
    ranges_.push_back(range_of(model.draws(), measured_, axis));
}

void MarkedDraws::draw_ranges(const ExplorerModel& model) const {
  const auto axes = plot_axes(model.table());
  if (!ImGui::BeginTable("ranges", 3, ImGuiTableFlags_SizingFixedFit)) return;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(axis_label(model.table(), axes[i]).c_str());
    ImGui::TableNextColumn();
    draw_track(model.default_range(axes[i]), ranges_[i]);
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", range_text(model.table(), axes[i], ranges_[i]).c_str());
  }
  ImGui::EndTable();
}

}  // namespace patina
