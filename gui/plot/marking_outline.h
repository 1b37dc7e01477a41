#pragma once

#include <vector>

#include "gui/explorer_model.h"

namespace patina {

/// What a drag in a plot draws around the draws that it marks.
enum class MarkingTool { box, lasso };

/// The outline of the draws that are being marked, while the mouse is down; in the plot's units, so that it
/// stays with the draws where the view moves.
class MarkingOutline {
 public:
  void begin(MarkingTool tool, PlotPlace at);
  void extend(PlotPlace to);
  void end() { path_.clear(); }

  bool active() const { return !path_.empty(); }
  std::vector<PlotPlace> outline() const;  ///< a box's four corners, or the lasso's path

 private:
  MarkingTool tool_ = MarkingTool::box;
  std::vector<PlotPlace> path_;
};

}  // namespace patina
