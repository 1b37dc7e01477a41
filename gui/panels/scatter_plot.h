#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>

#include "gui/gl/point_renderer.h"
#include "gui/pace.h"
#include "gui/panels/marking_cursor.h"
#include "gui/panels/marking_gesture.h"
#include "gui/panels/panel.h"
#include "gui/plot/credible_regions.h"
#include "gui/plot/draw_colours.h"
#include "gui/plot/histogram.h"
#include "gui/plot/plot_view.h"
#include "gui/preview/thumbnails.h"

namespace patina {

/// What a plot shows, and what a drag in it draws.
struct PlotSubject {
  PlotAxis x, y;
  MarkingTool tool = MarkingTool::box;
};

/// The cloud of draws over any two axes, as they arrive, with how they are spread along either. A click
/// selects the nearest draw, a drag marks draws; the wheel zooms, the right button moves the view, a double
/// click shows all draws again.
class ScatterPlot {
 public:
  /// @param thumbnails  outlives the plot
  ScatterPlot(const Gl& gl, Thumbnails& thumbnails);

  /// @param rect     all of it, tick labels included
  /// @param beneath  draws what lies between the ground and the points; may be empty
  void draw(const PanelContext& context, const Rect& rect, const PlotSubject& subject,
            const std::function<void(const PlotView&)>& beneath = {});

  /// Marks draws by keys from now on, or no more.
  void take_keys(bool taken) { taken ? cursor_.begin(view_) : cursor_.end(); }
  bool takes_keys() const { return cursor_.active(); }

  /// Where the plot was in the last frame, and what it showed.
  const PlotView& view() const { return view_; }
  const DrawColours& colours() const { return contents_.colours; }
  /// The draw that will be selected if the mouse button that is down comes up where it is.
  std::optional<std::size_t> held() const { return held_; }
  bool shows_density() const { return points_.shows_density(); }
  bool behind() const { return behind_; }                  ///< draws have come that are not shown yet
  bool redrew_density() const { return redrew_density_; }  ///< in this frame

 private:
  using Clock = std::chrono::steady_clock;
  /// What the points and bars were made from; anything else there means to begin again.
  struct Contents {
    int run = -1;
    PlotAxis x, y;
    bool hides_warmup = false;
    bool dims_warmup = false;  ///< not while there is nothing else to see
    DrawSet marked;
    DrawColours colours;
    bool operator==(const Contents&) const = default;
  };

  void place_plot(const Rect& rect);
  void follow_draws(const Session& session, const PlotSubject& subject);
  void send_points(const ExplorerModel& model);
  void append_points(const ExplorerModel& model);
  void count_bars(const Session& session);
  void draw_contours(const Session& session);
  void draw_marks(const ExplorerModel& model) const;
  void handle_mouse(Session& session, MarkingTool tool);
  std::optional<std::size_t> hit(const ExplorerModel& model, float reach) const;
  PlotPlace mouse_place() const;

  Thumbnails& thumbnails_;
  PointRenderer points_;
  Contents contents_;
  PlotView view_;
  bool following_ = false;  ///< the view has followed the draws since the frame before
  bool had_draws_ = false;  ///< in the frame before
  bool behind_ = false, redrew_density_ = false;
  Clock::time_point sent_at_;
  std::size_t sent_ = 0;     ///< draws given to the renderer
  std::size_t counted_ = 0;  ///< draws in the bars
  Histogram x_bars_, y_bars_;
  Pace bar_pace_;
  CredibleRegions regions_;
  MarkingGesture marking_;
  MarkingCursor cursor_;
  std::optional<std::size_t> held_;
};

}  // namespace patina
