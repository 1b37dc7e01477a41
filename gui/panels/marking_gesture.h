#pragma once

#include "gui/plot/marking_outline.h"
#include "gui/plot/plot_view.h"

struct ImGuiIO;

namespace patina {

/// What becomes of the draws that were marked before: Shift adds to them, Ctrl takes away.
Marking marking_of(const ImGuiIO& io);

/// Marks draws by a drag with the left button over a plot. Shift adds to what is marked, Ctrl takes away.
class MarkingGesture {
 public:
  /// Comes right after the item that covers the plot. @return whether the item was clicked, and nothing
  /// dragged
  bool handle(ExplorerModel& model, const PlotAxis& x, const PlotAxis& y, const PlotView& view,
              MarkingTool tool);

  void draw(const PlotView& view) const;  ///< the outline, if there is one
  bool active() const { return outline_.active(); }
  void cancel() { outline_.end(); }

 private:
  MarkingOutline outline_;
  DrawSet marked_before_;  ///< what was marked when the outline was begun
};

}  // namespace patina
