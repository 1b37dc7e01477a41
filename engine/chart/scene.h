#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "engine/image.h"

namespace patina {

/// In pixels, from the upper left corner.
struct ScenePoint {
  double x = 0, y = 0;
};

struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
  double opacity = 1;
};

struct SceneLine {
  ScenePoint from, to;
  Colour colour;
  double width = 1;
};

struct SceneDisc {
  ScenePoint centre;
  double radius = 1;
  Colour fill, rim;
  double rim_width = 0;
};

enum class Anchor { start, middle, end };

struct SceneText {
  ScenePoint at;  ///< on the base line
  std::string text;
  Anchor anchor = Anchor::start;
  double size = 13;
  Colour colour;
  bool strong = false;
};

/// A drawing, from back to front, on white.
struct Scene {
  int width = 1200, height = 800;
  std::string title;  ///< for readers that do not see it
  std::vector<std::variant<SceneLine, SceneDisc, SceneText>> shapes;
};

/// About how wide a text is drawn; fonts differ.
double text_width(const std::string& text, double size);

/// SVG 1.1.
std::string to_svg(const Scene& scene);

/// The same shapes as pixels, edges smoothed: 3 channels, display values. Text in Inter or DejaVu, whichever
/// is installed.
Image to_image(const Scene& scene);

/// FILE.svg and FILE.png. @throws UserError where writing fails
void write_scene(const std::filesystem::path& folder, const std::string& name, const Scene& scene);

}  // namespace patina
