#pragma once

#include "gui/panels/marked_draws.h"
#include "gui/panels/matrix_plot.h"
#include "gui/panels/panel.h"
#include "gui/panels/scatter_plot.h"
#include "gui/panels/trace_plot.h"

namespace patina {

/// The draws, as they arrive: over any two parameters, over every pair of them, or along the chains' steps;
/// with what to show and what colours tell.
class ScatterPanel {
 public:
  enum class Show { plot, pairs, trace };

  explicit ScatterPanel(const Gl& gl) : plot_(gl), matrix_(gl), trace_(gl) {}
  void draw(const PanelContext& context, const Rect& rect);

  /// Answers this frame's keys, where no text is being typed.
  void handle_keys(ExplorerModel& model);

  Show shown() const { return show_; }
  bool busy() const { return show_ == Show::pairs && matrix_.busy(); }  ///< another frame should follow

  /// Where the plot of two parameters was in the last frame, and what it showed.
  const PlotView& view() const { return plot_.view(); }
  const MatrixPlot& matrix() const { return matrix_; }
  const TracePlot& trace() const { return trace_; }

 private:
  void draw_tabs();
  void draw_choices(ExplorerModel& model);
  void draw_shown(ExplorerModel& model);
  void draw_plot(const PanelContext& context, const Rect& rect);
  void draw_tools(ExplorerModel& model);

  ScatterPlot plot_;
  MatrixPlot matrix_;
  TracePlot trace_;
  MarkedDraws marked_;
  Show show_ = Show::plot;
  MarkingTool tool_ = MarkingTool::box;
};

}  // namespace patina
