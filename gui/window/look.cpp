#include "gui/window/look.h"

#include <cmath>

#include "gui/window/theme.h"

namespace patina {
namespace {

constexpr float kFontSize = 15;  // at 96 dots per inch

}  // namespace

Fonts dress(const Window& window, const Preferences& preferences) {
  const float size = std::round(kFontSize * window.content_scale() * preferences.scale);
  theme::apply(size, preferences.light_theme ? theme::Theme::light : theme::Theme::dark);
  return load_fonts(size, window.pixel_density());
}

}  // namespace patina
