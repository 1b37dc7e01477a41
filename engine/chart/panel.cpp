#include "engine/chart/panel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace patina {
namespace {

constexpr double kTickSize = 12, kAxisNameSize = 13;

void draw_x_ticks(Scene& scene, const Panel& panel) {
  for (const Tick& tick : log_ticks(panel.x.low, panel.x.high)) {
    const double x = panel.x.pixel(tick.value);
    if (tick.label.empty()) {
      scene.shapes.push_back(SceneLine{{x, panel.area.bottom}, {x, panel.area.bottom + 3}, kPale});
      continue;
    }
    scene.shapes.push_back(SceneLine{{x, panel.area.top}, {x, panel.area.bottom + 5}, kFaint});
    add_text(scene, {x, panel.area.bottom + 18}, tick.label, Anchor::middle, kTickSize, kInk);
  }
}

void draw_y_ticks(Scene& scene, const Panel& panel) {
  for (const Tick& tick : log_ticks(panel.y.low, panel.y.high)) {
    const double y = panel.y.pixel(tick.value);
    if (tick.label.empty()) {
      scene.shapes.push_back(SceneLine{{panel.area.left - 3, y}, {panel.area.left, y}, kPale});
      continue;
    }
    scene.shapes.push_back(SceneLine{{panel.area.left - 5, y}, {panel.area.right, y}, kFaint});
    add_text(scene, {panel.area.left - 8, y + 4}, tick.label, Anchor::end, kTickSize, kInk);
  }
}

}  // namespace

Colour series_colour(std::size_t i) {
  constexpr std::array<Colour, 10> kColours{{{0, 114, 178},
                                             {213, 94, 0},
                                             {0, 158, 115},
                                             {204, 121, 167},
                                             {86, 160, 220},
                                             {190, 130, 0},
                                             {110, 60, 160},
                                             {150, 40, 40},
                                             {70, 110, 40},
                                             {90, 90, 90}}};
  return kColours[i % kColours.size()];
}

Panel::Panel(const Box& area_, LogAxis x_, LogAxis y_) : area(area_), x(x_), y(y_) {
  x.pixel_of_low = area.left;
  x.pixel_of_high = area.right;
  y.pixel_of_low = area.bottom;
  y.pixel_of_high = area.top;
}

void Panel::draw_frame(Scene& scene, const std::string& x_name, const std::string& y_name) const {
  draw_x_ticks(scene, *this);
  draw_y_ticks(scene, *this);
  const ScenePoint corner{area.left, area.bottom};
  scene.shapes.push_back(SceneLine{corner, {area.right, area.bottom}, kInk});
  scene.shapes.push_back(SceneLine{corner, {area.left, area.top}, kInk});
  add_text(scene, {area.left - 40, area.top - 10}, y_name, Anchor::start, kAxisNameSize, kInk, true);
  add_text(scene, {area.right, area.bottom + 36}, x_name, Anchor::end, kAxisNameSize, kInk, true);
}

void add_text(Scene& scene, const ScenePoint& at, const std::string& text, Anchor anchor, double size,
              const Colour& colour, bool strong) {
  scene.shapes.push_back(SceneText{at, text, anchor, size, colour, strong});
}

void add_name(Scene& scene, LabelPlacer& placer, const ScenePoint& point, const std::string& name,
              double size, const Colour& colour, bool strong) {
  constexpr double kFar = 16;  // pixels
  const Box box = placer.place(point, text_width(name, size), size);
  const ScenePoint nearest{std::clamp(point.x, box.left, box.right),
                           std::clamp(point.y, box.top, box.bottom)};
  if (std::hypot(nearest.x - point.x, nearest.y - point.y) > kFar)
    scene.shapes.push_back(SceneLine{point, nearest, {colour.red, colour.green, colour.blue, 0.5}, 0.8});
  add_text(scene, {(box.left + box.right) / 2, box.bottom - 0.18 * size}, name, Anchor::middle, size, colour,
           strong);
}

}  // namespace patina
