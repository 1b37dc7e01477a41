#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gui/draw_columns.h"
#include "gui/explorer_choices.h"
#include "gui/plot/plot_axis.h"

namespace patina {

/// A place in a plot, in the axes' units.
struct PlotPlace {
  double x = 0, y = 0;
};

/// What becomes of the draws that were marked before when others are.
enum class Marking { replace, add, remove };

/// What is explored: the draws so far, and what the user chose about them: the axes, which draws are shown,
/// which one is selected, which are marked. No ImGui, no threads. Draws are named by their index in draws().
class ExplorerModel {
 public:
  explicit ExplorerModel(ParameterTable table = {});

  const ParameterTable& table() const { return table_; }
  const DrawColumns& draws() const { return draws_; }
  void append(std::span<const Draw> draws);

  const ExplorerChoices& choices() const { return choices_; }
  void restore(const ExplorerChoices& choices);  ///< those of this model from before
  /// What the user chose about the draws of the same run, which come here again, in whatever order; but for
  /// those that were marked.
  void take_over(const ExplorerModel& earlier);

  PlotAxis x_axis() const { return choices_.x; }
  PlotAxis y_axis() const { return choices_.y; }
  void set_axes(const PlotAxis& x, const PlotAxis& y);  ///< other ones show all draws

  /// What is shown of the plot over two axes; none: all draws, as they arrive.
  std::optional<PlotPart> part(const PlotAxis& x, const PlotAxis& y) const;
  void show_part(const PlotPart& part);
  void show_all(const PlotAxis& x, const PlotAxis& y);

  const Colouring& colouring() const { return choices_.colouring; }
  void colour_by(const Colouring& colouring) { choices_.colouring = colouring; }

  bool shows_contours() const { return choices_.contours; }
  void show_contours(bool shown) { choices_.contours = shown; }

  bool warmup_hidden() const { return choices_.warmup_hidden; }  ///< whether the user wants that
  void hide_warmup(bool hidden) { choices_.warmup_hidden = hidden; }

  /// Warm-up draws are not hidden while there is nothing else to see.
  bool hides_warmup() const { return warmup_hidden() && draws_.sampling_count() > 0; }
  bool visible(std::size_t draw) const { return !hides_warmup() || !draws_.warmup(draw); }

  /// Whether a draw is part of the answer: it is not of warm-up, or there are no others yet.
  bool in_answer(std::size_t draw) const { return draws_.sampling_count() == 0 || !draws_.warmup(draw); }

  /// What an axis should span: the draws after warm-up, or all of them until there are any after it;
  /// without draws the prior's range.
  PlotRange default_range(const PlotAxis& axis) const;

  /// Where the middle 96 % of the answer lie along an axis, judged by a few thousand draws spread evenly over
  /// the run: what a scale of colours should span.
  PlotRange usual_range(const PlotAxis& axis) const;

  /// The visible draw closest to a point of the plot, by distance on screen; the first drawn of several that
  /// coincide.
  /// @param at           the point
  /// @param pixel        axis units per pixel, > 0
  /// @param reach        pixels within which a draw counts
  std::optional<std::size_t> nearest(const PlotAxis& x, const PlotAxis& y, PlotPlace at, PlotPlace pixel,
                                     double reach) const;

  std::optional<std::size_t> selected() const { return choices_.selected; }
  void select(std::optional<std::size_t> draw);
  /// Selects a draw once it arrives, unless something else is selected before.
  void await(const DrawPlace& place);
  const std::optional<DrawPlace>& awaited() const { return awaited_; }

  /// The visible draw with the highest lp.
  std::optional<std::size_t> best() const;

  /// Selects the visible draw of the next lower lp, or the next higher one; draws that repeat another are
  /// passed over. Nothing selected: the best. At the end of the row nothing happens. Returns whether the
  /// selection changed.
  bool select_worse();
  bool select_better();

  const DrawSet& marked() const { return choices_.marked; }
  void mark(const DrawSet& draws, Marking how);

  /// The visible draws inside an outline, which closes itself; of one that crosses itself what an odd number
  /// of lines parts from the outside.
  DrawSet inside(const PlotAxis& x, const PlotAxis& y, std::span<const PlotPlace> outline) const;

  const std::vector<Star>& stars() const { return choices_.stars; }
  void set_stars(std::vector<Star> stars);  ///< those that were kept with the run
  bool starred(std::size_t draw) const;
  void star(std::size_t draw, bool on);
  void toggle_star(std::size_t draw) { star(draw, !starred(draw)); }
  void annotate(std::size_t star, const std::string& note);  ///< a star by its index
  /// The draw that a star belongs to; none as long as it has not arrived.
  std::optional<std::size_t> draw_of(const Star& star) const;

 private:
  void find_starred(std::size_t from);

  ParameterTable table_;
  DrawColumns draws_;
  ExplorerChoices choices_;
  std::optional<DrawPlace> awaited_;
  std::map<DrawPlace, std::size_t> starred_draws_;  ///< where the draws are that were starred once
};

/// From the lowest to the highest place of a set's draws along an axis; [0, 0] for an empty one.
PlotRange range_of(const DrawColumns& draws, const DrawSet& set, const PlotAxis& axis);

}  // namespace patina
