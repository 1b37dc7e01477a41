#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/material/parameter.h"

namespace patina {

/// What an axis of a plot shows.
struct PlotAxis {
  enum class Kind { continuous, discrete, log_posterior, iteration };
  Kind kind = Kind::log_posterior;
  std::size_t index = 0;  ///< in the table's continuous or discrete parameters
  bool operator==(const PlotAxis&) const = default;
};

/// A stretch of an axis, in the axis' own unit.
struct PlotRange {
  double low = 0;
  double high = 1;
  double span() const { return high - low; }
  bool operator==(const PlotRange&) const = default;
};

/// The part that is shown of a plot over two axes.
struct PlotPart {
  PlotAxis x, y;
  PlotRange across, up;
  bool operator==(const PlotPart&) const = default;
};

/// What a material's draws can be compared by: its continuous parameters, its discrete ones, lp.
std::vector<PlotAxis> plot_axes(const ParameterTable& table);

/// The axis in words, with its unit: "Bump frequency (cycles/cm)".
std::string axis_label(const ParameterTable& table, const PlotAxis& axis);

/// A number's text at a place on the axis; a discrete axis shows its level's name, and nothing between
/// levels.
std::string tick_label(const ParameterTable& table, const PlotAxis& axis, double value);

/// Round numbers (1, 2 or 5 times a power of ten apart) inside the range, at most `most` of them, rising.
std::vector<double> round_ticks(const PlotRange& range, int most);

/// The range with a margin of 6 % on either side; one without extent becomes one that has some.
PlotRange padded(const PlotRange& range);

/// The view that follows growing data without trembling: `view` while the data lie inside it and fill at
/// least half of it, else the padded data.
PlotRange followed(const PlotRange& view, const PlotRange& data);

}  // namespace patina
