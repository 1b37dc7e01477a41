#pragma once

#include <cstddef>

#include "gui/preview/thumbnails.h"

namespace patina {

/// A tooltip about a draw: its render, where it lies along two axes, how well it matches, which one it is.
void draw_hover(const Session& session, Thumbnails& thumbnails, std::size_t draw, const PlotAxis& x,
                const PlotAxis& y);

}  // namespace patina
