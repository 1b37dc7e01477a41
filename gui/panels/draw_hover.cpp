#include "gui/panels/draw_hover.h"

#include <imgui.h>

#include <cmath>
#include <string>

#include "gui/window/theme.h"
#include "gui/words.h"

namespace patina {

void draw_hover(const Session& session, Thumbnails& thumbnails, std::size_t draw, const PlotAxis& x,
                const PlotAxis& y) {
  const ExplorerModel& model = session.model();
  const DrawColumns& draws = model.draws();
  const auto line = [&](const PlotAxis& axis) {
    const double place = draws.place(axis, draw);
    const bool discrete = axis.kind == PlotAxis::Kind::discrete;
    return axis_label(model.table(), axis) + ": " +
           tick_label(model.table(), axis, discrete ? std::round(place) : place) + "\n";
  };
  std::string text;
  const PlotAxis match{PlotAxis::Kind::log_posterior, 0};
  if (x.kind != PlotAxis::Kind::iteration) text += line(x);
  if (y != x) text += line(y);
  if (x != match && y != match) text += line(match);
  text += "Chain " + std::to_string(draws.chain(draw) + 1) + ", step " +
          count_text(draws.iteration(draw) + 1) + (draws.warmup(draw) ? " (warm-up)" : "");

  const float side = 8.5f * ImGui::GetFontSize();
  ImGui::BeginTooltip();
  const ImVec2 corner = ImGui::GetCursorScreenPos(), end{corner.x + side, corner.y + side};
  ImGui::Dummy({side, side});
  if (const Texture* picture = thumbnails.find(session, draw, Thumbnails::kSmall, true)) {
    ImGui::GetWindowDrawList()->AddImage(picture->imgui_id(), corner, end);
  } else {
    ImGui::GetWindowDrawList()->AddRectFilled(corner, end, theme::kWell);
  }
  ImGui::TextUnformatted(text.c_str());
  ImGui::EndTooltip();
}

}  // namespace patina
