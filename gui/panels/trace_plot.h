#pragma once

#include <cstddef>
#include <vector>

#include "gui/panels/scatter_plot.h"
#include "gui/plot/chain_trace.h"

namespace patina {

/// A parameter along the chains' steps, warm-up shaded: chains that have found the answer wander over the
/// same values, with no trend. What one can do in a scatter plot one can do here.
class TracePlot {
 public:
  TracePlot(const Gl& gl, Thumbnails& thumbnails) : plot_(gl, thumbnails) {}
  void draw(const PanelContext& context, const Rect& rect, MarkingTool tool);

  ScatterPlot& plot() { return plot_; }
  const ScatterPlot& plot() const { return plot_; }

 private:
  void follow(const ExplorerModel& model, int run);
  void draw_courses(const ExplorerModel& model, const PlotView& view) const;

  ScatterPlot plot_;
  std::vector<ChainTrace> chains_;
  int run_ = -1;
  PlotAxis axis_;
  bool hides_warmup_ = false;
  std::size_t added_ = 0;  ///< draws in chains_
};

}  // namespace patina
