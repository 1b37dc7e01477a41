#pragma once

#include <vector>

#include "gui/plot/marking_outline.h"
#include "gui/plot/plot_view.h"

namespace patina {

/// A place in a plot that keys move, and the outline around draws that they set corner by corner. In the
/// plot's units. No ImGui.
class PlotCursor {
 public:
  void begin(const PlotView& view);  ///< in its middle
  void end();
  bool active() const { return active_; }

  PlotPlace place() const { return place_; }
  /// By shares of what is shown; stops at its edges.
  void move(double right, double up, const PlotView& view);

  enum class Step {
    opened,  ///< the outline goes on
    closed,  ///< finished() holds what it went around
    pointed  ///< twice in one place: at a draw, as a click is
  };
  /// Sets a corner here: the second one of a box closes it, a lasso is closed by one where the one before is.
  Step set_corner(MarkingTool tool);

  /// What is drawn so far, this place included; empty before the first corner.
  std::vector<PlotPlace> outline(MarkingTool tool) const;
  const std::vector<PlotPlace>& finished() const { return finished_; }

 private:
  bool active_ = false;
  PlotPlace place_;
  std::vector<PlotPlace> corners_, finished_;
};

}  // namespace patina
