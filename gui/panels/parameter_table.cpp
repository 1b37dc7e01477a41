#include "gui/panels/parameter_table.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "engine/run/verdict.h"
#include "gui/advice.h"
#include "gui/panels/parameter_curve.h"
#include "gui/window/theme.h"
#include "gui/words.h"

namespace patina {
namespace {

constexpr double kBadRhat = 1.1;

const QuantitySummary* find(const std::optional<RunSummary>& summary, const std::string& name) {
  if (!summary) return nullptr;
  const auto& all = summary->quantities;
  const auto it =
      std::find_if(all.begin(), all.end(), [&](const QuantitySummary& q) { return q.name == name; });
  return it != all.end() && std::isfinite(it->mean) ? &*it : nullptr;
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

/// Whether the draws of the run that is open are of the parameters in the table.
bool shows_run(const Session& session) {
  const ParameterTable& material = session.choices().material();
  return session.run_is_of_choice() &&
         session.model().table().continuous.size() == material.continuous.size() &&
         session.model().table().discrete.size() == material.discrete.size();
}

/// What the curves span: all that the material allows, and what a run was allowed beside.
std::vector<PlotRange> ranges_of(const ParameterTable& material, const ParameterTable* run) {
  std::vector<PlotRange> ranges;
  for (std::size_t i = 0; i < material.continuous.size(); ++i) {
    const TruncatedNormal& own = material.continuous[i].prior;
    const TruncatedNormal& used = run != nullptr ? run->continuous[i].prior : own;
    ranges.push_back({std::min(own.low, used.low), std::max(own.high, used.high)});
  }
  return ranges;
}

/// The levels' shares of the draws, side by side, the shown one's in the accent colour.
void draw_shares(const DiscreteParameter& parameter, const std::vector<std::uint32_t>* counts, int level) {
  std::vector<std::uint32_t> equal(parameter.levels.size(), 1);
  const std::vector<std::uint32_t>& shown = counts != nullptr ? *counts : equal;
  const double total = std::max(1.0, std::accumulate(shown.begin(), shown.end(), 0.0));
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = 1.25f * ImGui::GetTextLineHeight();
  float x = corner.x;
  std::string text;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const float part = width * static_cast<float>(shown[i] / total);
    const bool current = static_cast<int>(i) == level;
    ImGui::GetWindowDrawList()->AddRectFilled({x, corner.y},
                                              {x + std::max(part - 1, 0.0f), corner.y + height},
                                              current ? theme::kAccent : theme::kLine);
    x += part;
    text += (text.empty() ? "" : "\n") + capitalised(parameter.levels[i]) + ": " +
            number_text(100 * shown[i] / total, 2) + " %";
  }
  ImGui::Dummy({width, height});
  tooltip((counts != nullptr ? "Share of the draws\n" : "Assumed before looking\n") + text);
}

}  // namespace

void ParameterTableView::follow(const Session& session) {
  constexpr std::size_t kMost = 50'000;  // draws a frame: a few milliseconds
  const ParameterTable& material = session.choices().material();
  const bool has_run = shows_run(session);
  if (run_version_ != session.run_version() || material_ != material.material) {
    ranges_ = ranges_of(material, has_run ? &session.model().table() : nullptr);
    histograms_ = ParameterHistograms(material, ranges_);
    run_version_ = session.run_version();
    material_ = material.material;
    has_bars_ = false;
  }
  // A live run asks for a frame soon enough to take in what is left out here.
  if (has_run && has_bars_ && !behind_ && session.is_live() && !pace_.due()) return;
  behind_ = has_run && !histograms_.follow(session.model().draws(), kMost);
  has_bars_ = has_run && histograms_.total() > 0;
}

void ParameterTableView::draw_lock_and_name(const PanelContext& context, const std::string& name,
                                            double value, const std::string& about) {
  RunChoices& choices = context.session.choices();
  const bool locked = choices.locked(name);
  ImGui::TableNextColumn();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float half = 0.5f * ImGui::GetTextLineHeight();
  places_.push_back({{corner.x + half, corner.y + half}, {}});
  if (draw_lock("lock", locked)) {
    context.commands.push_back(
        [&choices, name, value, locked] { locked ? choices.unlock(name) : choices.lock(name, value); });
  }
  tooltip(locked ? "Locked for the next run. Click to let it be inferred again"
                 : "Click to hold it at the value that is shown, in the next run");
  ImGui::SameLine(0, 0.3f * ImGui::GetFontSize());
  ImGui::TextUnformatted(parameter_label(name).c_str());
  tooltip(about);
}

void ParameterTableView::draw_continuous(const PanelContext& context, std::size_t index, double value) {
  const Session& session = context.session;
  const RunChoices& choices = session.choices();
  const Parameter& parameter = choices.table().continuous[index];
  const QuantitySummary* quantity = has_bars_ ? find(session.summary(), parameter.name) : nullptr;
  const bool locked = choices.locked(parameter.name);
  ImGui::TableNextRow();
  draw_lock_and_name(context, parameter.name, value, about(parameter, quantity, value));
  ImGui::TableNextColumn();
  ParameterCurve curve{parameter.prior, ranges_[index], {}, value, quantity && not_pinned_down(*quantity),
                       locked};
  if (has_bars_) curve.histogram = histograms_.continuous(index);
  const bool clicked = draw_parameter_curve("curve", curve);
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  places_.back().curve = {0.5f * (low.x + high.x), 0.5f * (low.y + high.y)};
  if (clicked) editor_.open(parameter.name, {ImGui::GetWindowPos().x - ImGui::GetFontSize(), low.y});
  tooltip(about(parameter, quantity, value) + "\nClick to change what is assumed");
  ImGui::TableNextColumn();
  if (locked) {
    ImGui::TextDisabled("locked at %s", number_text(choices.settings().fixed.at(parameter.name)).c_str());
  } else {
    draw_knowledge(quantity);
  }
  ImGui::TableNextColumn();
  draw_rhat(quantity);
}

void ParameterTableView::draw_discrete(const PanelContext& context, std::size_t index, int level) {
  const Session& session = context.session;
  const DiscreteParameter& parameter = session.choices().table().discrete[index];
  const QuantitySummary* quantity = has_bars_ ? find(session.summary(), parameter.name) : nullptr;
  const bool known = level >= 0 && level < static_cast<int>(parameter.levels.size());
  ImGui::TableNextRow();
  draw_lock_and_name(context, parameter.name, level, parameter.description);
  ImGui::TableNextColumn();
  draw_shares(parameter, has_bars_ ? &histograms_.discrete(index) : nullptr, level);
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(known ? capitalised(parameter.levels[static_cast<std::size_t>(level)]).c_str()
                               : "\u2013");
  ImGui::TableNextColumn();
  draw_rhat(quantity);
}

void ParameterTableView::draw_rows(const PanelContext& context, const ParameterValues& values) {
  places_.clear();
  for (std::size_t i = 0; i < values.continuous.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    draw_continuous(context, i, values.continuous[i]);
    ImGui::PopID();
  }
  for (std::size_t i = 0; i < values.discrete.size(); ++i) {
    ImGui::PushID(static_cast<int>(values.continuous.size() + i));
    draw_discrete(context, i, values.discrete[i]);
    ImGui::PopID();
  }
}

void ParameterTableView::draw(const PanelContext& context, const ShownDraw& shown) {
  const Session& session = context.session;
  follow(session);
  const ParameterValues values = shows_run(session) ? shown.values : session.choices().typical();
  const float em = ImGui::GetFontSize();
  if (ImGui::BeginTable("parameters", 4, ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingFixedFit)) {
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("Parameter", ImGuiTableColumnFlags_WidthFixed, 8.8f * em);
    ImGui::TableSetupColumn("Range", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("Mean \u00b1 sd", ImGuiTableColumnFlags_WidthFixed, 6.8f * em);
    ImGui::TableSetupColumn("R-hat", ImGuiTableColumnFlags_WidthFixed, 2.4f * em);
    ImGui::PushStyleColor(ImGuiCol_Text, theme::kMuted);
    ImGui::TableHeadersRow();
    ImGui::PopStyleColor();
    draw_rows(context, values);
    ImGui::EndTable();
  }
  editor_.draw(context);
}

}  // namespace patina
