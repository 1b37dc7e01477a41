#pragma once

#include <cstddef>

#include "gui/gl/point_renderer.h"
#include "gui/panels/panel.h"
#include "gui/plot_view.h"

namespace patina {

/// The cloud of draws over any two parameters, as they arrive. A click selects the nearest draw; the wheel
/// zooms, the right button moves the view, a double click shows all draws again.
class ScatterPanel {
 public:
  explicit ScatterPanel(const Gl& gl);
  void draw(const PanelContext& context, const Rect& rect);

  /// Where the plot was in the last frame, and what it showed.
  const PlotView& view() const { return view_; }

 private:
  /// What the renderer's points were made from; anything else there means to begin again.
  struct Contents {
    int run = -1;
    PlotAxis x, y;
    bool hides_warmup = false;
    bool dims_warmup = false;  ///< not while there is nothing else to see
    bool operator==(const Contents&) const = default;
  };

  void draw_choices(const PanelContext& context);
  void place_plot();
  void follow_draws(const Session& session);
  void send_points(const ExplorerModel& model);
  void handle_mouse(ExplorerModel& model);
  void draw_marks(const ExplorerModel& model) const;
  void draw_hover(const ExplorerModel& model) const;

  PointRenderer points_;
  Contents contents_;
  PlotView view_;
  bool following_ = true;  ///< the view follows the draws until the user moves it
  std::size_t sent_ = 0;   ///< draws given to the renderer
};

}  // namespace patina
