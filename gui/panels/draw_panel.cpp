#include "gui/panels/draw_panel.h"

#include <algorithm>

#include "gui/window/theme.h"
#include "gui/words.h"

namespace patina {
namespace {

std::string describe(const Session& session, const ShownDraw& shown) {
  const ExplorerModel& model = session.model();
  if (shown.kind == ShownDraw::Kind::typical)
    return std::string("The middle of what this material usually is") +
           (session.has_run() ? ", until a match for the photo is found."
                              : ". Press Start to fit it to the photo.");
  std::string text = "Match " + number_text(shown.lp, 4);
  if (const auto best = model.best(); best && shown.kind == ShownDraw::Kind::selected) {
    const double below = model.draws().lp(*best) - shown.lp;
    text += below > 0 ? ", " + number_text(below, 3) + " below the best" : ", the best so far";
  }
  if (shown.draw) {
    text += "\nChain " + std::to_string(model.draws().chain(*shown.draw) + 1) + ", step " +
            count_text(model.draws().iteration(*shown.draw) + 1) +
            (model.draws().warmup(*shown.draw) ? " (warm-up)" : "");
  }
  return text;
}

void draw_walk(const PanelContext& context, const ShownDraw& shown) {
  ExplorerModel& model = context.session.model();
  ImGui::BeginDisabled(model.draws().size() == 0);
  if (ImGui::ArrowButton("##better", ImGuiDir_Left))
    context.commands.push_back([&model] { model.select_better(); });
  tooltip("The next better draw (left arrow)");
  ImGui::SameLine();
  if (ImGui::ArrowButton("##worse", ImGuiDir_Right))
    context.commands.push_back([&model] { model.select_worse(); });
  tooltip("The next less likely draw (right arrow)");
  ImGui::SameLine();
  if (ImGui::Button("Best")) context.commands.push_back([&model] { model.select(model.best()); });
  tooltip("Select the draw that matches best");
  ImGui::SameLine();
  const bool starred = shown.draw && model.starred(*shown.draw);
  ImGui::BeginDisabled(!shown.draw);
  if (ImGui::Button(starred ? "Unstar" : "Star")) {
    context.commands.push_back([&model, draw = *shown.draw] { model.toggle_star(draw); });
  }
  tooltip(starred ? "Take the star away (S)" : "Keep this draw in the gallery (S)");
  ImGui::EndDisabled();
  ImGui::EndDisabled();
}

void draw_export_news(const ExportNews& news) {
  if (!news.done) {
    if (!news.note.empty()) elided_text(news.note, ImGui::GetContentRegionAvail().x, theme::kAccent);
    return;
  }
  ImGui::PushStyleColor(ImGuiCol_PlotHistogram, theme::kAccent);
  ImGui::ProgressBar(static_cast<float>(*news.done), {-1, 0.35f * ImGui::GetFontSize()}, "");
  ImGui::PopStyleColor();
}

}  // namespace

void draw_draw_panel(const PanelContext& context, const Rect& rect, const ShownDraw& shown,
                     const ExportNews& news, const std::function<void()>& ask_to_export,
                     const std::function<void()>& cancel_export) {
  const PanelScope panel((shown_draw_title(shown) + "###draw").c_str(), rect, context,
                         ImGuiWindowFlags_NoScrollbar);
  muted_text(describe(context.session, shown));
  draw_export_news(news);
  const float bottom = ImGui::GetContentRegionMax().y - ImGui::GetFrameHeight();
  ImGui::SetCursorPosY(std::max(ImGui::GetCursorPosY(), bottom));
  draw_walk(context, shown);
  const char* label = news.done ? "Cancel export" : "Export...";
  align_right(button_width(label));
  if (ImGui::Button(label)) context.commands.push_back(news.done ? cancel_export : ask_to_export);
  tooltip(news.done ? "End it; files that were written stay"
                    : "Write this draw's parameters, render and maps to a folder (Ctrl+E)");
}

}  // namespace patina
