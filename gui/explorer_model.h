#pragma once

#include <optional>
#include <span>

#include "gui/draw_columns.h"
#include "gui/plot_axis.h"

namespace patina {

/// What is explored: the draws so far, the two axes, which draws are shown, which one is selected. No ImGui,
/// no threads. Draws are named by their index in draws().
class ExplorerModel {
 public:
  explicit ExplorerModel(ParameterTable table = {});

  const ParameterTable& table() const { return table_; }
  const DrawColumns& draws() const { return draws_; }
  void append(std::span<const Draw> draws) { draws_.append(draws); }

  PlotAxis x_axis() const { return x_; }
  PlotAxis y_axis() const { return y_; }
  void set_axes(const PlotAxis& x, const PlotAxis& y);

  bool warmup_hidden() const { return warmup_hidden_; }  ///< whether the user wants that
  void hide_warmup(bool hidden) { warmup_hidden_ = hidden; }

  /// Warm-up draws are not hidden while there is nothing else to see.
  bool hides_warmup() const { return warmup_hidden_ && draws_.sampling_count() > 0; }
  bool visible(std::size_t draw) const { return !hides_warmup() || !draws_.warmup(draw); }

  /// What an axis should span: the draws after warm-up, or all of them until there are any after it;
  /// without draws the prior's range.
  PlotRange default_range(const PlotAxis& axis) const;

  /// The visible draw closest to a point of the plot, by distance on screen; the first drawn of several that
  /// coincide.
  /// @param x,y          the point, in the axes' units
  /// @param pixel_x,pixel_y  axis units per pixel, > 0
  /// @param reach        pixels within which a draw counts
  std::optional<std::size_t> nearest(double x, double y, double pixel_x, double pixel_y, double reach) const;

  std::optional<std::size_t> selected() const { return selected_; }
  void select(std::optional<std::size_t> draw);

  /// The visible draw with the highest lp.
  std::optional<std::size_t> best() const;

  /// Selects the visible draw of the next lower lp, or the next higher one; draws that repeat another are
  /// passed over. Nothing selected: the best. At the end of the row nothing happens. Returns whether the
  /// selection changed.
  bool select_worse();
  bool select_better();

 private:
  ParameterTable table_;
  DrawColumns draws_;
  PlotAxis x_, y_;
  bool warmup_hidden_ = false;
  std::optional<std::size_t> selected_;
};

}  // namespace patina
