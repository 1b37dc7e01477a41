#include "gui/panels/chains_panel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "gui/theme.h"
#include "gui/words.h"

namespace patina {
namespace {

/// From 0 to 1: of the search while searching, of warm-up and draws together afterwards.
float progress(const RunStatus& status, const RunSettings& settings) {
  if (status.phase == RunPhase::finished) return 1;
  if (status.phase == RunPhase::starting) return 0;
  if (status.phase == RunPhase::searching) return static_cast<float>(status.search_fraction);
  double made = 0;
  for (const ChainStatus& chain : status.chains) made += static_cast<double>(chain.iteration);
  const double all = std::max(1.0, static_cast<double>(settings.chains) * (settings.warmup + settings.draws));
  return static_cast<float>(std::clamp(made / all, 0.0, 1.0));
}

ImU32 phase_color(RunPhase phase) {
  if (phase == RunPhase::failed) return theme::kError;
  return is_active(phase) ? theme::kAccent : theme::kMuted;
}

void draw_progress(const RunStatus& status, const RunSettings& settings) {
  const float fraction = progress(status, settings);
  ImGui::PushStyleColor(ImGuiCol_PlotHistogram, phase_color(status.phase));
  ImGui::ProgressBar(fraction, {-1, 0.35f * ImGui::GetFontSize()}, "");
  ImGui::PopStyleColor();
}

/// Beside the panel's title: what the run is doing, and how much of it is done.
void draw_phase(const PanelContext& context) {
  const RunStatus& status = context.session.status();
  ImGui::SameLine();
  ImGui::PushStyleColor(ImGuiCol_Text, phase_color(status.phase));
  ImGui::TextUnformatted(phase_text(status.phase).c_str());
  ImGui::PopStyleColor();
  const std::size_t draws = context.session.model().draws().size();
  if (draws == 0) return;
  std::string right = count_text(static_cast<long long>(draws)) + " draws";
  if (is_active(status.phase) && status.draws_per_second > 0) {
    right += ", " + number_text(status.draws_per_second, 2) + "/s";
  }
  align_right(ImGui::CalcTextSize(right.c_str()).x);
  elided_text(right, ImGui::GetContentRegionAvail().x, theme::kMuted);
}

/// The worst R-hat and the smallest ESS over all quantities: the two numbers that decide whether to wait.
std::string agreement(const RunSummary& summary) {
  double rhat = 0, ess = std::numeric_limits<double>::infinity();
  for (const QuantitySummary& quantity : summary.quantities) {
    if (std::isfinite(quantity.rhat)) rhat = std::max(rhat, quantity.rhat);
    if (std::isfinite(quantity.bulk_ess)) ess = std::min(ess, quantity.bulk_ess);
  }
  if (rhat == 0 || !std::isfinite(ess)) return {};
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "R-hat up to %.2f, ESS at least %.0f", rhat, std::floor(ess));
  return text.data();
}

/// The line below the bar: why a run stopped, else how far the chains agree, else what the run says of
/// itself.
std::string news(const Session& session) {
  const RunStatus& status = session.status();
  const std::string agreed = session.summary() ? agreement(*session.summary()) : std::string();
  const bool told = status.phase == RunPhase::failed || status.phase == RunPhase::paused;
  if (!agreed.empty() && !told) return agreed;
  return status.phase == RunPhase::warming_up ? "Whether the chains agree shows after warm-up"
                                              : status.message;
}

void draw_chain_row(int number, const ChainStatus& chain) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float line = ImGui::GetTextLineHeight();
  ImGui::GetWindowDrawList()->AddCircleFilled({corner.x + 0.4f * line, corner.y + 0.55f * line}, 0.28f * line,
                                              theme::chain_color(number));
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + line);
  ImGui::Text("%d", number + 1);
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(count_text(chain.iteration).c_str());
  ImGui::TableNextColumn();
  ImGui::Text("%.0f %%", 100 * chain.acceptance);
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(number_text(chain.step_size, 2).c_str());
  ImGui::TableNextColumn();
  ImGui::PushStyleColor(ImGuiCol_Text, chain.divergences > 0 ? theme::kWarning : theme::kText);
  ImGui::TextUnformatted(count_text(chain.divergences).c_str());
  ImGui::PopStyleColor();
}

void draw_chain_table(const RunStatus& status, float height) {
  if (!ImGui::BeginTable("chains", 5, ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingStretchProp,
                         {0, height}))
    return;
  ImGui::TableSetupScrollFreeze(0, 1);
  for (const char* name : {"Chain", "Steps", "Accepted", "Step size", "Diverged"})
    ImGui::TableSetupColumn(name);
  ImGui::PushStyleColor(ImGuiCol_Text, theme::kMuted);
  ImGui::TableHeadersRow();
  ImGui::PopStyleColor();
  for (std::size_t i = 0; i < status.chains.size(); ++i)
    draw_chain_row(static_cast<int>(i), status.chains[i]);
  ImGui::EndTable();
}

void draw_buttons(const PanelContext& context) {
  Session& session = context.session;
  const RunPhase phase = session.status().phase;
  if (!session.run().can_control()) {
    muted_text(is_over(phase) ? "This run was read from its directory."
                              : "Another program is making this run; watch it here.");
    return;
  }
  if (session.can_go_on()) {
    if (ImGui::Button("Continue", {-1, 0})) context.commands.push_back([&session] { session.go_on(); });
    tooltip("Draw on in this run; what was drawn is kept");
    return;
  }
  const float gap = ImGui::GetStyle().ItemSpacing.x, half = 0.5f * (ImGui::GetContentRegionAvail().x - gap);
  ImGui::BeginDisabled(is_over(phase));
  const bool paused = phase == RunPhase::paused;
  if (paused ? primary_button("Resume", {half, 0}) : ImGui::Button("Pause", {half, 0})) {
    context.commands.push_back([&session, paused] { paused ? session.resume() : session.pause(); });
  }
  tooltip(paused ? "Go on drawing (space)" : "Hold the chains where they are (space)");
  ImGui::SameLine();
  if (ImGui::Button("Stop", {half, 0})) context.commands.push_back([&session] { session.stop(); });
  tooltip("End the run; what was drawn is kept");
  ImGui::EndDisabled();
}

}  // namespace

void draw_chains_panel(const PanelContext& context, const Rect& rect) {
  const PanelScope panel("Chains", rect, context, ImGuiWindowFlags_NoScrollbar);
  const Session& session = context.session;
  if (!session.has_run()) {
    muted_text(session.has_photo()
                   ? "Press Start: four chains will look for everything this material could be."
                   : "Nothing is running.");
    return;
  }
  draw_phase(context);
  draw_progress(session.status(), session.run().settings());
  elided_text(news(session), ImGui::GetContentRegionAvail().x, theme::kMuted);
  const float buttons = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemSpacing.y;
  draw_chain_table(session.status(), std::max(1.0f, ImGui::GetContentRegionAvail().y - buttons));
  draw_buttons(context);
}

}  // namespace patina
