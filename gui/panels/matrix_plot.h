#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "gui/gl/objects.h"
#include "gui/panels/marking_gesture.h"
#include "gui/panels/panel.h"
#include "gui/plot/pair_grids.h"
#include "gui/plot/plot_view.h"

namespace patina {

/// Every pair of parameters at once: below the diagonal how the draws lie over two of them, on it how they
/// are spread along one. Scrolls where there are too many to shrink. A click names a pair to see large, a
/// drag marks draws.
class MatrixPlot {
 public:
  explicit MatrixPlot(const Gl& gl) : gl_(gl) {}

  struct Pair {
    PlotAxis x, y;
  };
  /// @return the pair that was clicked
  std::optional<Pair> draw(const PanelContext& context, const Rect& rect, MarkingTool tool);

  /// Whether some draws are not counted or pictured yet: another frame should follow.
  bool busy() const { return busy_; }

  /// Where a pair's cell was in the last frame. @param column  at most `row`
  PlotView cell_view(std::size_t row, std::size_t column) const;

 private:
  struct Place {
    std::size_t row = 0, column = 0;
    bool operator==(const Place&) const = default;
  };

  void place_cells(const Rect& rect);
  PairGrids::Part visible_part() const;
  void bring_up_to_date(const ExplorerModel& model);
  void make_atlas();
  bool send_pictures(const PairGrids::Part& part, PairGrids::Clock::time_point deadline);
  void draw_cells(const ExplorerModel& model, const PairGrids::Part& part) const;
  void draw_points(const ExplorerModel& model, const Place& place) const;
  void draw_hover(const ExplorerModel& model, const Place& place) const;
  void draw_labels(const ExplorerModel& model) const;
  std::optional<Pair> handle_mouse(ExplorerModel& model, MarkingTool tool);
  std::optional<Place> place_at(ImVec2 pixel) const;

  const Gl& gl_;
  PairGrids grids_;
  std::optional<Texture> atlas_;       ///< all cells side by side, as they lie on the screen
  std::vector<std::size_t> pictured_;  ///< draws in each cell's picture; rows x columns
  int edition_ = -1;
  ImVec2 corner_{0, 0};  ///< of the first cell, on the screen
  ImVec2 cell_{1, 1};    ///< every cell's size, gap included
  bool busy_ = false;
  MarkingGesture marking_;
  std::optional<Place> pressed_;  ///< the cell where the mouse went down
};

}  // namespace patina
