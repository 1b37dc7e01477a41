#include "gui/panels/scatter_panel.h"

#include "gui/panels/colour_legend.h"
#include "gui/window/theme.h"

namespace patina {
namespace {

constexpr float kAxisWidth = 11.5f;    // em
constexpr float kColourWidth = 11.0f;  // em

/// A choice among a table's axes. @return whether it changed
bool choose_axis(const char* id, const ParameterTable& table, PlotAxis& axis) {
  bool changed = false;
  ImGui::SetNextItemWidth(kAxisWidth * ImGui::GetFontSize());
  if (!ImGui::BeginCombo(id, axis_label(table, axis).c_str(), ImGuiComboFlags_HeightLarge)) return false;
  for (const PlotAxis& choice : plot_axes(table)) {
    if (ImGui::Selectable(axis_label(table, choice).c_str(), choice == axis)) {
      axis = choice;
      changed = true;
    }
  }
  ImGui::EndCombo();
  return changed;
}

}  // namespace

void ScatterPanel::draw(const PanelContext& context, const Rect& rect, const GalleryActions& actions) {
  const PanelScope panel("Draws", rect, context,
                         ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  Session& session = context.session;
  thumbnails_wait_ = false;
  if (!session.has_run()) {
    return centred_hint(
        rect, session.has_photo()
                  ? "Every point here will be a material that could have made the photo. Press Start."
                  : "Open a photo to find out which materials could have made it.");
  }
  draw_tabs();
  if (show_ == Show::gallery) {
    gallery_.draw(context, {ImGui::GetCursorScreenPos(), ImGui::GetContentRegionAvail()}, actions);
  } else {
    draw_plots(context);
  }
  // To shade one and to draw a density anew are each most of a frame's time for a software rasteriser.
  thumbnails_wait_ = show_ == Show::plot && plot_.redrew_density();
  if (!thumbnails_wait_) thumbnails_.serve();
}

void ScatterPanel::show(Show what) {
  if (what != show_) take_keys(false);
  show_ = what;
}

std::optional<std::size_t> ScatterPanel::held() const {
  if (show_ == Show::plot) return plot_.held();
  return show_ == Show::trace ? trace_.plot().held() : std::nullopt;
}

void ScatterPanel::take_keys(bool taken) {
  if (taken && show_ != Show::trace) show_ = Show::plot;
  plot_.take_keys(taken && show_ == Show::plot);
  trace_.plot().take_keys(taken && show_ == Show::trace);
}

void ScatterPanel::draw_plots(const PanelContext& context) {
  ExplorerModel& model = context.session.model();
  draw_choices(model);
  const ScatterPlot& plot = show_ == Show::trace ? trace_.plot() : plot_;
  draw_colour_legend(model, plot.colours(), show_ == Show::pairs || plot.shows_density());
  marked_.draw(model);
  const ImVec2 corner = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
  draw_plot(context, {corner, {room.x, room.y - ImGui::GetFrameHeightWithSpacing()}});
  ImGui::SetCursorScreenPos({corner.x, corner.y + room.y - ImGui::GetFrameHeight()});
  draw_tools(model);
}

void ScatterPanel::draw_tabs() {
  const auto tab = [&](const char* label, Show show, const char* hint) {
    ImGui::SameLine();
    if (toggle_button(label, show_ == show)) this->show(show);
    tooltip(hint);
  };
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ImGui::GetStyle().FramePadding.x, 0});
  tab("One plot", Show::plot, "The draws over two parameters (P)");
  tab("All pairs", Show::pairs, "Every parameter over every other (A)");
  tab("Trace", Show::trace, "One parameter along the chains' steps (T)");
  tab("Gallery", Show::gallery, "Starred draws and kinds of solution, as pictures (G)");
  ImGui::PopStyleVar();
}

void ScatterPanel::draw_plot(const PanelContext& context, const Rect& rect) {
  ExplorerModel& model = context.session.model();
  switch (show_) {
    case Show::plot:
      return plot_.draw(context, rect, {model.x_axis(), model.y_axis(), tool_});
    case Show::trace:
      return trace_.draw(context, rect, tool_);
    case Show::pairs:
      if (const auto pair = matrix_.draw(context, rect, tool_)) {
        model.set_axes(pair->x, pair->y);
        show_ = Show::plot;
      }
      return;
    case Show::gallery:
      return;
  }
}

void ScatterPanel::draw_choices(ExplorerModel& model) {
  PlotAxis y = model.y_axis();
  if (show_ != Show::pairs) {
    if (choose_axis("##up", model.table(), y)) model.set_axes(model.x_axis(), y);
    tooltip("What the plot shows upwards");
    ImGui::SameLine();
  }
  Colouring colouring = model.colouring();
  if (choose_colouring("##colour", kColourWidth * ImGui::GetFontSize(), model.table(), colouring))
    model.colour_by(colouring);
  draw_shown(model);
}

void ScatterPanel::draw_shown(ExplorerModel& model) {
  const float width = 5.2f * ImGui::GetFontSize();
  align_right(width);
  ImGui::SetNextItemWidth(width);
  if (!ImGui::BeginCombo("##show", "Show", ImGuiComboFlags_HeightLarge)) {
    tooltip("What else the plot shows");
    return;
  }
  bool contours = model.shows_contours();
  ImGui::BeginDisabled(show_ != Show::plot);
  if (ImGui::Checkbox("Contours (K)", &contours)) model.show_contours(contours);
  ImGui::EndDisabled();
  tooltip("Lines around the smallest regions that hold half of the draws, and nine in ten.");
  bool warmup = !model.warmup_hidden();
  if (ImGui::Checkbox("Warm-up", &warmup)) model.hide_warmup(!warmup);
  tooltip("The chains' first steps too, dimmed. They are not part of the answer.");
  ImGui::EndCombo();
}

void ScatterPanel::draw_tools(ExplorerModel& model) {
  const auto choose = [&](const char* label, MarkingTool tool, const char* hint) {
    if (toggle_button(label, tool_ == tool)) tool_ = tool;
    tooltip(hint);
    ImGui::SameLine();
  };
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("Drag marks:");
  ImGui::SameLine();
  choose(
      "Box", MarkingTool::box,
      "Drag a box around draws to mark them in every plot (B).\nHold Shift to add to what is marked, Ctrl to "
      "take away.");
  choose("Lasso", MarkingTool::lasso,
         "Drag a line around draws to mark them in every plot (L).\nHold Shift to add to what is marked, "
         "Ctrl to "
         "take away.");
  if (show_ != Show::plot) return;
  align_right(kAxisWidth * ImGui::GetFontSize());
  PlotAxis x = model.x_axis();
  if (choose_axis("##across", model.table(), x)) model.set_axes(x, model.y_axis());
  tooltip("What the plot shows across");
}

}  // namespace patina
