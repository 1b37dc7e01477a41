#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/run/stars.h"
#include "gui/draw_set.h"
#include "gui/plot/plot_axis.h"

namespace patina {

/// What the colour of a draw tells.
struct Colouring {
  enum class Kind {
    automatic,  ///< the chain, until draws cover each other; how many there are from then on
    density,    ///< how many draws there are
    chain,
    axis  ///< a parameter or the match
  };
  Kind kind = Kind::automatic;
  PlotAxis axis;  ///< of Kind::axis
  bool operator==(const Colouring&) const = default;
};

/// What the user chose about the draws of a run; a value, so that undo can go back to it.
struct ExplorerChoices {
  PlotAxis x, y;
  std::vector<PlotPart> parts;  ///< of the plots of which not all is shown
  Colouring colouring;
  bool warmup_hidden = false;
  bool contours = false;  ///< drawn around half of the draws and nine in ten
  std::optional<std::size_t> selected;
  DrawSet marked;
  std::vector<Star> stars;  ///< in the order in which they were given
  bool operator==(const ExplorerChoices&) const = default;
};

}  // namespace patina
