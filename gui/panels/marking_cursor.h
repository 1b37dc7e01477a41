#pragma once

#include "gui/plot/plot_cursor.h"

namespace patina {

/// Marks draws without a mouse: arrows move a cursor over a plot, with Shift by less, and Enter or Space sets
/// the corners of a box or a lasso around draws. Shift with these adds to what is marked, Ctrl takes away.
/// Twice in one place selects the nearest draw.
class MarkingCursor {
 public:
  void begin(const PlotView& view) { cursor_.begin(view); }
  void end() { cursor_.end(); }
  bool active() const { return cursor_.active(); }

  /// Takes the frame's keys. @param reach  within which a draw can be selected, pixels
  void handle(ExplorerModel& model, const PlotAxis& x, const PlotAxis& y, const PlotView& view,
              MarkingTool tool, double reach);

  void draw(const PlotView& view, MarkingTool tool) const;

 private:
  PlotCursor cursor_;
};

}  // namespace patina
