#pragma once

#include <vector>

#include "gui/explorer_model.h"

namespace patina {

/// How many draws are marked, at the right edge of the line before: with a button that shows what their
/// parameters range over, and one that lets go of them. Nothing while no draw is marked.
class MarkedDraws {
 public:
  void draw(ExplorerModel& model);
  void show_ranges() { open_ = true; }  ///< as the button does

 private:
  void measure(const ExplorerModel& model);
  void draw_ranges(const ExplorerModel& model) const;

  bool open_ = false;
  DrawSet measured_;               ///< what ranges_ are of
  std::vector<PlotRange> ranges_;  ///< along every axis
};

}  // namespace patina
