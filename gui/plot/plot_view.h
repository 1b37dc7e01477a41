#pragma once

#include "gui/plot/plot_axis.h"

namespace patina {

/// Where a plot lies on the screen and what part of the plane it shows. Screen y grows downwards, plot y
/// upwards.
struct PlotView {
  float left = 0, top = 0, width = 1, height = 1;  ///< pixels
  PlotRange x, y;

  float pixel_of_x(double value) const {
    return static_cast<float>(left + (value - x.low) / x.span() * width);
  }
  float pixel_of_y(double value) const {
    return static_cast<float>(top + (y.high - value) / y.span() * height);
  }
  double x_of_pixel(float pixel) const { return x.low + (pixel - left) / width * x.span(); }
  double y_of_pixel(float pixel) const { return y.high - (pixel - top) / height * y.span(); }
  double x_per_pixel() const { return x.span() / width; }
  double y_per_pixel() const { return y.span() / height; }
};

/// The range shown after zooming by a factor (below 1: closer) about a value, which stays where it is.
PlotRange zoomed(const PlotRange& range, double about, double factor);

/// The range shown after moving by an amount.
PlotRange moved(const PlotRange& range, double by);

}  // namespace patina
