#include "gui/panels/parameter_table.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "gui/panels/panel.h"
#include "gui/theme.h"
#include "gui/words.h"

namespace patina {
namespace {

constexpr double kNotPinnedDown = 0.9;  // posterior sd / prior sd, above which the photo says nothing
constexpr double kGoodRhat = 1.01, kBadRhat = 1.1;

const QuantitySummary* find(const std::optional<RunSummary>& summary, const std::string& name) {
  if (!summary) return nullptr;
  const auto& all = summary->quantities;
  const auto it =
      std::find_if(all.begin(), all.end(), [&](const QuantitySummary& q) { return q.name == name; });
  return it != all.end() && std::isfinite(it->mean) ? &*it : nullptr;
}

bool not_pinned_down(const QuantitySummary& quantity) { return quantity.sd_over_prior_sd > kNotPinnedDown; }

/// The prior's range as a track, the central 90 % of the posterior on it, and a tick at the shown value.
void draw_range(const TruncatedNormal& prior, const QuantitySummary* quantity, double value) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, line = ImGui::GetTextLineHeight();
  const float middle = corner.y + 0.55f * line, half = 0.14f * line;
  const auto at = [&](double v) {
    return corner.x +
           width * static_cast<float>(std::clamp((v - prior.low) / (prior.high - prior.low), 0.0, 1.0));
  };
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({corner.x, middle - half}, {corner.x + width, middle + half}, theme::kLine, half);
  if (quantity != nullptr) {
    const float from = at(quantity->q5), to = std::max(at(quantity->q95), from + 2);
    list.AddRectFilled({from, middle - half}, {to, middle + half},
                       not_pinned_down(*quantity) ? theme::kWarning : theme::kAccent, half);
  }
  const float tick = at(value);
  list.AddRectFilled({tick - 1, middle - 0.4f * line}, {tick + 1, middle + 0.4f * line}, theme::kText);
  ImGui::Dummy({width, line});
}

void draw_knowledge(const QuantitySummary* quantity) {
  if (quantity == nullptr) {
    ImGui::TextDisabled("\u2013");
  } else if (not_pinned_down(*quantity)) {
    ImGui::PushStyleColor(ImGuiCol_Text, theme::kWarning);
    ImGui::TextUnformatted("not pinned down");
    ImGui::PopStyleColor();
    tooltip("Not pinned down by this photo: its spread is " +
            number_text(100 * quantity->sd_over_prior_sd, 2) + " % of what was assumed before looking (" +
            mean_sd_text(quantity->mean, quantity->sd) + "). Choose its value by taste.");
  } else {
    ImGui::TextUnformatted(mean_sd_text(quantity->mean, quantity->sd).c_str());
  }
}

void draw_rhat(const QuantitySummary* quantity) {
  if (quantity == nullptr || !std::isfinite(quantity->rhat)) {
    ImGui::TextDisabled("\u2013");
    return;
  }
  const double rhat = quantity->rhat;
  const ImU32 color = rhat < kGoodRhat ? theme::kAccent : rhat < kBadRhat ? theme::kText : theme::kWarning;
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  ImGui::Text("%.2f", rhat);
  ImGui::PopStyleColor();
  tooltip("The chains " + std::string(rhat < kBadRhat ? "agree" : "do not agree yet") +
          " on this parameter (1 is perfect, below 1.1 is usable).\nWorth " +
          number_text(quantity->bulk_ess, 3) + " independent draws (ESS).");
}

std::string about(const Parameter& parameter, const QuantitySummary* quantity, double value) {
  const std::string unit = parameter.unit.empty() ? "" : " " + parameter.unit;
  std::string text = parameter.description.empty() ? parameter_label(parameter.name) : parameter.description;
  text += "\nAssumed before looking: " + number_text(parameter.prior.mean) + " \u00b1 " +
          number_text(parameter.prior.sd) + unit + ", from " + number_text(parameter.prior.low) + " to " +
          number_text(parameter.prior.high);
  if (quantity != nullptr) {
    text += "\nAfter looking, nine in ten draws lie from " + number_text(quantity->q5) + " to " +
            number_text(quantity->q95);
  }
  return text + "\nShown in the preview: " + number_text(value, 4) + unit;
}

void draw_continuous(const Parameter& parameter, const QuantitySummary* quantity, double value) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(parameter_label(parameter.name).c_str());
  tooltip(about(parameter, quantity, value));
  ImGui::TableNextColumn();
  draw_range(parameter.prior, quantity, value);
  tooltip(about(parameter, quantity, value));
  ImGui::TableNextColumn();
  draw_knowledge(quantity);
  ImGui::TableNextColumn();
  draw_rhat(quantity);
}

void draw_discrete(const DiscreteParameter& parameter, const QuantitySummary* quantity, int level) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(parameter_label(parameter.name).c_str());
  if (!parameter.description.empty()) tooltip(parameter.description);
  ImGui::TableNextColumn();
  const bool known = level >= 0 && level < static_cast<int>(parameter.levels.size());
  ImGui::TextUnformatted(known ? capitalised(parameter.levels[static_cast<std::size_t>(level)]).c_str()
                               : "\u2013");
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%d choices", static_cast<int>(parameter.levels.size()));
  ImGui::TableNextColumn();
  draw_rhat(quantity);
}

}  // namespace

void draw_parameter_table(const ParameterTable& table, const std::optional<RunSummary>& summary,
                          const ParameterValues& values) {
  const float em = ImGui::GetFontSize();
  if (!ImGui::BeginTable("parameters", 4, ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingFixedFit)) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("Parameter", ImGuiTableColumnFlags_WidthFixed, 8.4f * em);
  ImGui::TableSetupColumn("Range", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("Mean \u00b1 sd", ImGuiTableColumnFlags_WidthFixed, 7.2f * em);
  ImGui::TableSetupColumn("R-hat", ImGuiTableColumnFlags_WidthFixed, 2.6f * em);
  ImGui::PushStyleColor(ImGuiCol_Text, theme::kMuted);
  ImGui::TableHeadersRow();
  ImGui::PopStyleColor();
  for (std::size_t i = 0; i < table.continuous.size(); ++i) {
    draw_continuous(table.continuous[i], find(summary, table.continuous[i].name), values.continuous[i]);
  }
  for (std::size_t i = 0; i < table.discrete.size(); ++i) {
    draw_discrete(table.discrete[i], find(summary, table.discrete[i].name), values.discrete[i]);
  }
  ImGui::EndTable();
}

}  // namespace patina
