#pragma once

#include "gui/panels/marked_draws.h"
#include "gui/panels/panel.h"
#include "gui/panels/scatter_plot.h"

namespace patina {

/// The draws, as they arrive: over any two parameters, with what to show and what colours tell.
class ScatterPanel {
 public:
  explicit ScatterPanel(const Gl& gl) : plot_(gl) {}
  void draw(const PanelContext& context, const Rect& rect);

  /// Answers this frame's keys, where no text is being typed.
  void handle_keys(ExplorerModel& model);

  /// Where the plot was in the last frame, and what it showed.
  const PlotView& view() const { return plot_.view(); }

 private:
  void draw_choices(ExplorerModel& model);
  void draw_shown(ExplorerModel& model);
  void draw_tools(ExplorerModel& model);

  ScatterPlot plot_;
  MarkedDraws marked_;
  MarkingTool tool_ = MarkingTool::box;
};

}  // namespace patina
