#include "gui/panels/chains_panel.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "engine/run/all_alarms.h"
#include "gui/alarm_words.h"
#include "gui/panels/run_rules.h"
#include "gui/run_outlook.h"
#include "gui/window/theme.h"
#include "gui/words.h"

namespace patina {
namespace {

constexpr const char* kCosts = "Costs...";

/// The table's columns, and what they mean.
constexpr std::array<std::pair<const char*, const char*>, 5> kColumns{
    {{"Chain", "Independent walks through the possible materials"},
     {"Steps", "How many steps the chain has made, warm-up included"},
     {"Accepted", "How many of the steps that it tried it took: a chain that takes few hardly moves"},
     {"Step size", "How far a step reaches; warm-up finds it"},
     {"Diverged",
      "Steps that went astray where the posterior bends sharply, and were not taken. A few in a thousand do "
      "no harm; many may mean that a corner of the answer is missing"}}};

ImU32 phase_color(RunPhase phase) {
  if (phase == RunPhase::failed) return theme::kError;
  return is_active(phase) ? theme::kAccent : theme::kMuted;
}

std::optional<StopEvidence> evidence_of(const Session& session) {
  if (!session.summary()) return std::nullopt;
  return stop_evidence(*session.summary());
}

void draw_progress(const RunOutlook& outlook, RunPhase phase) {
  ImGui::PushStyleColor(ImGuiCol_PlotHistogram, phase_color(phase));
  ImGui::ProgressBar(outlook.done, {-1, 0.35f * ImGui::GetFontSize()}, "");
  ImGui::PopStyleColor();
}

/// Beside the panel's title: what the run is doing, and how much of it is done.
void draw_phase(const PanelContext& context) {
  const RunStatus& status = context.session.status();
  ImGui::SameLine();
  ImGui::PushStyleColor(ImGuiCol_Text, phase_color(status.phase));
  ImGui::TextUnformatted(phase_text(status.phase).c_str());
  ImGui::PopStyleColor();
  if (!status.message.empty()) tooltip(sentence(status.message));
  const std::size_t draws = context.session.model().draws().size();
  if (draws == 0) return;
  std::string right = count_text(static_cast<long long>(draws)) + " draws";
  if (is_active(status.phase) && status.draws_per_second > 0) {
    right += ", " + number_text(status.draws_per_second, 2) + "/s";
  }
  align_right(ImGui::CalcTextSize(right.c_str()).x);
  elided_text(right, ImGui::GetContentRegionAvail().x, theme::kMuted);
}

/// While a run directory is read, which for a million draws takes a moment.
void draw_reading(const PanelContext& context) {
  Session& session = context.session;
  ImGui::SameLine();
  ImGui::PushStyleColor(ImGuiCol_Text, theme::kAccent);
  ImGui::TextUnformatted("Reading its draws");
  ImGui::PopStyleColor();
  ImGui::PushStyleColor(ImGuiCol_PlotHistogram, theme::kAccent);
  ImGui::ProgressBar(static_cast<float>(session.status().read_fraction), {-1, 0.35f * ImGui::GetFontSize()},
                     "");
  ImGui::PopStyleColor();
  muted_text(count_text(static_cast<long long>(session.model().draws().size())) + " so far");
  ImGui::SetCursorPosY(ImGui::GetContentRegionMax().y - ImGui::GetFrameHeight());
  if (ImGui::Button("Cancel", {-1, 0})) context.commands.push_back([&session] { session.close_run(); });
  tooltip("Close this run; nothing in its directory changes");
}

/// What a sentence says before it explains.
std::string beginning(const std::string& sentence) { return sentence.substr(0, sentence.find(':')); }

/// Below the bar: when the run will end, or why it has; then how far the chains agree.
void draw_news(const Session& session, const RunOutlook& outlook,
               const std::optional<StopEvidence>& evidence) {
  const RunStatus& status = session.status();
  const float width = ImGui::GetContentRegionAvail().x;
  if (is_active(status.phase)) {
    elided_text(outlook_text(outlook), width, theme::kMuted);
  } else {
    const std::string ended = sentence(status.message);
    elided_text(beginning(ended), width, theme::kMuted, ended);
  }
  if (!evidence) return elided_text("Whether the chains agree shows after warm-up", width, theme::kMuted);
  const std::string agreement = agreement_text(*evidence);
  elided_text(agreement, width, theme::kMuted,
              agreement +
                  "\nR-hat tells how far the chains agree on the parameter on which they agree least: 1 is "
                  "perfect, below 1.1 is usable.\nNeighbouring steps of a chain resemble each other: so many "
                  "independent draws are what all of them are worth for the parameter that is known least "
                  "well (ESS).");
}

/// Whether the draws are worth listening to: at first chains are missing, and what moves slowly looks stuck.
bool can_be_judged(const Session& session) {
  constexpr std::int64_t kFewest = 100;  // draws of each chain
  if (!session.summary()) return false;
  const std::vector<ChainSummary>& chains = session.summary()->chains;
  return is_over(session.status().phase) ||
         (std::ssize(chains) == session.run().settings().chains &&
          std::ranges::all_of(chains, [](const ChainSummary& chain) { return chain.draws >= kFewest; }));
}

/// What the run says against itself: the beginning of the first, all of it in a tooltip.
void draw_alarms(const Session& session) {
  const DrawSource& run = session.run();
  const RunStatus& status = session.status();
  const Alarms alarms = can_be_judged(session)
                            ? all_alarms(run.settings(), run.table(), status, *session.summary())
                            : status.alarms;
  if (alarms.empty()) return;
  const std::string mind =
      alarms.size() == 1 ? "Mind: " : "Mind " + std::to_string(alarms.size()) + " things: ";
  std::string all;
  for (const Alarm& alarm : alarms) all += (all.empty() ? "" : "\n\n") + by_controls(alarm.sentence);
  elided_text(mind + beginning(by_controls(alarms.front().sentence)), ImGui::GetContentRegionAvail().x,
              theme::kWarning, all);
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
  if (chain.iteration == 0) return;  // there is nothing to say of the rest yet
  ImGui::TableNextColumn();
  ImGui::Text("%.0f %%", 100 * chain.acceptance);
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(number_text(chain.step_size, 2).c_str());
  ImGui::TableNextColumn();
  ImGui::PushStyleColor(ImGuiCol_Text, chain.divergences > 0 ? theme::kWarning : theme::kText);
  ImGui::TextUnformatted(count_text(chain.divergences).c_str());
  ImGui::PopStyleColor();
}

/// Closer than other tables, so that four chains show beside an alarm in a window as it opens.
void draw_chain_table(const RunStatus& status, float height) {
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding,
                      {ImGui::GetStyle().CellPadding.x, 0.25f * ImGui::GetStyle().CellPadding.y});
  const bool shown = ImGui::BeginTable(
      "chains", 5, ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingStretchProp, {0, height});
  ImGui::PopStyleVar();
  if (!shown) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  for (const auto& [name, meaning] : kColumns) ImGui::TableSetupColumn(name);
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  ImGui::PushStyleColor(ImGuiCol_Text, theme::kMuted);
  for (const auto& [name, meaning] : kColumns) {
    ImGui::TableNextColumn();
    ImGui::TableHeader(name);
    tooltip(meaning);
  }
  ImGui::PopStyleColor();
  for (std::size_t i = 0; i < status.chains.size(); ++i)
    draw_chain_row(static_cast<int>(i), status.chains[i]);
  ImGui::EndTable();
}

/// What can be asked at any time.
void draw_questions(const PanelContext& context, const std::function<void()>& show_costs) {
  draw_run_rules(context);
  ImGui::SameLine();
  if (ImGui::Button(kCosts)) context.commands.push_back(show_costs);
  tooltip("How fast draws come, how sure they make the answer, and what other ways to draw would cost");
}

void draw_buttons(const PanelContext& context, const std::function<void()>& show_costs) {
  Session& session = context.session;
  const RunPhase phase = session.status().phase;
  if (!session.run().can_control() && !is_over(phase)) {
    muted_text("Another program is making this run; watch it here.");
    return;
  }
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float room = ImGui::GetContentRegionAvail().x - 2 * gap - run_rules_width() - button_width(kCosts);
  if (session.can_go_on()) {
    if (ImGui::Button("Continue", {room, 0})) context.commands.push_back([&session] { session.go_on(); });
    tooltip("Draw on in this run; what was drawn is kept");
    ImGui::SameLine();
    return draw_questions(context, show_costs);
  }
  const float half = 0.5f * (room - gap);
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
  ImGui::SameLine();
  draw_questions(context, show_costs);
}

}  // namespace

void draw_chains_panel(const PanelContext& context, const Rect& rect,
                       const std::function<void()>& show_costs) {
  const PanelScope panel("Chains", rect, context, ImGuiWindowFlags_NoScrollbar);
  const Session& session = context.session;
  if (!session.has_run()) {
    muted_text(session.has_photo()
                   ? "Press Start: four chains will look for everything this material could be."
                   : "Nothing is running.");
    return draw_questions(context, show_costs);
  }
  if (session.status().read_fraction < 1) return draw_reading(context);
  draw_phase(context);
  const std::optional<StopEvidence> evidence = evidence_of(session);
  const RunOutlook outlook =
      run_outlook(session.status(), in_force(session.run().settings(), session.status()), evidence,
                  session.seconds_spent());
  draw_progress(outlook, session.status().phase);
  draw_news(session, outlook, evidence);
  draw_alarms(session);
  const float buttons = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemSpacing.y;
  draw_chain_table(session.status(), std::max(1.0f, ImGui::GetContentRegionAvail().y - buttons));
  draw_buttons(context, show_costs);
}

}  // namespace patina
