#include "engine/chart/chart_title.h"

#include "engine/chart/panel.h"

namespace patina {

void draw_title(Scene& scene, const ChartTitle& title, const std::string& what) {
  scene.title = what + ": " + title.target;
  add_text(scene, {24, 28}, what + ": " + title.target, Anchor::start, 17, kInk, true);
  add_text(scene, {24, 48}, title.gold, Anchor::start, 12.5, kInk);
  add_text(scene, {24, 65}, title.how, Anchor::start, 12.5, kPale);
}

}  // namespace patina
