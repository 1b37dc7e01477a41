#pragma once

#include "gui/panels/gallery.h"
#include "gui/panels/marked_draws.h"
#include "gui/panels/matrix_plot.h"
#include "gui/panels/panel.h"
#include "gui/panels/scatter_plot.h"
#include "gui/panels/trace_plot.h"

namespace patina {

/// The draws, as they arrive: over any two parameters, over every pair of them, along the chains' steps, or
/// as pictures; with what to show and what colours tell.
class ScatterPanel {
 public:
  enum class Show { plot, pairs, trace, gallery };

  /// @param wake  called from other threads when there is something new to draw
  ScatterPanel(const Gl& gl, const std::function<void()>& wake)
      : thumbnails_(gl, wake),
        plot_(gl, thumbnails_),
        matrix_(gl),
        trace_(gl, thumbnails_),
        gallery_(thumbnails_, wake) {}
  void draw(const PanelContext& context, const Rect& rect, const GalleryActions& actions);

  Show shown() const { return show_; }
  void show(Show what);
  /// Marks draws by keys from now on, in one plot or the trace, or no more.
  void take_keys(bool taken);
  bool takes_keys() const { return plot_.takes_keys() || trace_.plot().takes_keys(); }
  void take(MarkingTool tool) { tool_ = tool; }  ///< to mark draws with
  void show_marked_ranges() { marked_.show_ranges(); }
  bool busy() const { return show_ == Show::pairs && matrix_.busy(); }  ///< another frame should follow
  /// Likewise, in a moment.
  bool behind() const { return thumbnails_wait_ || (show_ == Show::plot && plot_.behind()); }

  /// Where the plot of two parameters was in the last frame, and what it showed.
  const PlotView& view() const { return plot_.view(); }
  /// The draw that will be selected if the mouse button that is down comes up where it is.
  std::optional<std::size_t> held() const;
  const MatrixPlot& matrix() const { return matrix_; }
  const TracePlot& trace() const { return trace_; }
  const Gallery& gallery() const { return gallery_; }

 private:
  void draw_tabs();
  void draw_choices(ExplorerModel& model);
  void draw_shown(ExplorerModel& model);
  void draw_plots(const PanelContext& context);
  void draw_plot(const PanelContext& context, const Rect& rect);
  void draw_tools(ExplorerModel& model);

  Thumbnails thumbnails_;
  ScatterPlot plot_;
  MatrixPlot matrix_;
  TracePlot trace_;
  Gallery gallery_;
  MarkedDraws marked_;
  bool thumbnails_wait_ = false;
  Show show_ = Show::plot;
  MarkingTool tool_ = MarkingTool::box;
};

}  // namespace patina
