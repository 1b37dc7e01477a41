#include "gui/plot/draw_colours.h"

#include <cmath>

namespace patina {

void DrawColours::follow(const ExplorerModel& model, int run) {
  const bool same = run == run_ && model.colouring() == colouring_;
  run_ = run;
  theme_ = theme::in_force();
  colouring_ = model.colouring();
  if (!is_scale()) {
    range_ = {};
    return;
  }
  const PlotRange usual = model.usual_range(colouring_.axis);
  range_ = same ? followed(range_, usual) : padded(usual);
}

bool DrawColours::is_scale() const {
  return colouring_.kind == Colouring::Kind::axis && colouring_.axis.kind != PlotAxis::Kind::discrete;
}

ImU32 DrawColours::of(const ExplorerModel& model, std::size_t draw) const {
  const DrawColumns& draws = model.draws();
  if (colouring_.kind != Colouring::Kind::axis) return theme::chain_color(draws.chain(draw));
  const double place = draws.place(colouring_.axis, draw);
  if (!is_scale()) return theme::chain_color(static_cast<int>(std::lround(place)));
  return theme::ramp_color((place - range_.low) / range_.span());
}

}  // namespace patina
