#pragma once

#include "gui/panels/panel.h"
#include "gui/preview/preview_view.h"

namespace patina {

/// What is shown, how it is compared, its exposure: one row.
void draw_preview_controls(PreviewView& view, bool has_photo);

/// Gain and sign of a difference: one row.
void draw_difference_controls(PreviewView& view);

/// Pixels a side of the maps, as wide as `width`.
void draw_preview_resolution(PreviewView& view, float width);

}  // namespace patina
