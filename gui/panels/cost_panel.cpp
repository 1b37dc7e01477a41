#include "gui/panels/cost_panel.h"

#include <algorithm>
#include <exception>

#include "gui/panels/cost_plot.h"
#include "gui/window/theme.h"

namespace patina {
namespace {

void draw_spent(const Session& session) {
  const auto seconds = session.seconds_spent();
  if (!session.has_run() || !session.summary() || !seconds) return;
  const double rate = session.status().draws_per_second;
  const std::string text = spent_text(stop_evidence(*session.summary()), *seconds, rate);
  ImGui::TextWrapped("%s", text.empty() ? "There are too few draws to say what they cost." : text.c_str());
  ImGui::Spacing();
}

void draw_chart(const CostChart& chart, const RunSettings& settings) {
  const auto own = find_cost(chart, settings);
  const float em = ImGui::GetFontSize();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 size{ImGui::GetContentRegionAvail().x,
                    ImGui::GetContentRegionAvail().y - 7 * ImGui::GetTextLineHeightWithSpacing()};
  draw_cost_plot(chart, own, {corner, {size.x, std::max(size.y, 10 * em)}});
  ImGui::Dummy({size.x, std::max(size.y, 10 * em)});
  if (own)
    ImGui::TextWrapped("%s", alternatives_text(chart, *own).c_str());
  else
    ImGui::TextWrapped("This run draws in a way that the chart does not have.");
  muted_text(
      "Ways to draw, as measured for " + chart.target +
      ". Left is cheap, down is right; full points are off by more than chance, the ring is this run's way.");
}

}  // namespace

void CostPanel::follow(const std::string& material) {
  if (material == material_) return;
  material_ = material;
  chart_.reset();
  problem_.clear();
  try {
    chart_ = read_cost_chart(bundled_chart_file(material));
  } catch (const std::exception& error) {
    problem_ = error.what();
  }
}

void CostPanel::draw(const PanelContext& context) {
  constexpr const char* kName = "How fast, how sure##costs";
  if (!begin_box(kName, open_, {52, 44})) return;
  const Session& session = context.session;
  const RunSettings settings =
      session.has_run() ? in_force(session.run().settings(), session.status()) : session.settings();
  follow(settings.material);
  heading_text(context, "How fast, how sure");
  ImGui::BeginChild("chart", {0, -ImGui::GetFrameHeightWithSpacing()});
  draw_spent(session);
  if (chart_)
    draw_chart(*chart_, settings);
  else
    muted_text(problem_.empty()
                   ? "No chart of this material comes with the program; patina-cli chart makes one."
                   : problem_);
  ImGui::EndChild();
  if (ImGui::Button("Close")) open_ = false;
  if (!open_) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace patina
