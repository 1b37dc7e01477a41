#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>

#include "engine/chart/scene.h"

namespace patina {
namespace {

constexpr std::array<const char*, 2> kRegular{"/usr/share/fonts/opentype/inter/Inter-Regular.otf",
                                              "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"};
constexpr std::array<const char*, 2> kStrong{"/usr/share/fonts/opentype/inter/Inter-SemiBold.otf",
                                             "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf"};

/// The first that is there; empty for OpenImageIO's own choice.
std::string font(bool strong) {
  std::error_code ignored;
  for (const char* file : strong ? kStrong : kRegular)
    if (std::filesystem::exists(file, ignored)) return file;
  return "";
}

class Canvas {
 public:
  Canvas(int width, int height) : image_(width, height, 3) { std::ranges::fill(image_.pixels, 1.0f); }

  void draw(const SceneLine& line) {
    const double reach = line.width / 2 + 1;
    const double dx = line.to.x - line.from.x, dy = line.to.y - line.from.y;
    const double length2 = std::max(dx * dx + dy * dy, 1e-12);
    for_each_pixel(std::min(line.from.x, line.to.x) - reach, std::max(line.from.x, line.to.x) + reach,
                   std::min(line.from.y, line.to.y) - reach, std::max(line.from.y, line.to.y) + reach,
                   [&](double x, double y, int row, int column) {
                     const double along =
                         std::clamp(((x - line.from.x) * dx + (y - line.from.y) * dy) / length2, 0.0, 1.0);
                     const double distance =
                         std::hypot(x - line.from.x - along * dx, y - line.from.y - along * dy);
                     blend(row, column, line.colour, line.width / 2 - distance);
                   });
  }

  void draw(const SceneDisc& disc) {
    const double outer = disc.radius + disc.rim_width / 2, reach = outer + 1;
    const ScenePoint c = disc.centre;
    for_each_pixel(c.x - reach, c.x + reach, c.y - reach, c.y + reach,
                   [&](double x, double y, int row, int column) {
                     const double distance = std::hypot(x - c.x, y - c.y);
                     blend(row, column, disc.fill, disc.radius - distance);
                     if (disc.rim_width > 0)
                       blend(row, column, disc.rim, disc.rim_width / 2 - std::abs(distance - disc.radius));
                   });
  }

  void draw(const SceneText& text) {
    using namespace OIIO;
    const auto align = text.anchor == Anchor::start    ? ImageBufAlgo::TextAlignX::Left
                       : text.anchor == Anchor::middle ? ImageBufAlgo::TextAlignX::Center
                                                       : ImageBufAlgo::TextAlignX::Right;
    ImageBuf buffer(ImageSpec(image_.width, image_.height, 3, TypeDesc::FLOAT), image_.pixels.data());
    const std::array<float, 3> colour{text.colour.red / 255.0f, text.colour.green / 255.0f,
                                      text.colour.blue / 255.0f};
    ImageBufAlgo::render_text(buffer, static_cast<int>(std::lround(text.at.x)),
                              static_cast<int>(std::lround(text.at.y)), text.text,
                              static_cast<int>(std::lround(text.size)), font(text.strong), colour, align);
  }

  Image take() { return std::move(image_); }

 private:
  template <typename Visit>
  void for_each_pixel(double left, double right, double top, double bottom, Visit visit) {
    const int first_row = std::max(static_cast<int>(top), 0);
    const int last_row = std::min(static_cast<int>(bottom), image_.height - 1);
    const int first_column = std::max(static_cast<int>(left), 0);
    const int last_column = std::min(static_cast<int>(right), image_.width - 1);
    for (int row = first_row; row <= last_row; ++row)
      for (int column = first_column; column <= last_column; ++column)
        visit(column + 0.5, row + 0.5, row, column);
  }

  /// @param inside  how far, in pixels, the pixel's centre lies inside the shape
  void blend(int row, int column, const Colour& colour, double inside) {
    const auto cover = static_cast<float>(std::clamp(inside + 0.5, 0.0, 1.0) * colour.opacity);
    const std::array<std::uint8_t, 3> rgb{colour.red, colour.green, colour.blue};
    for (int c = 0; c < 3; ++c) {
      float& pixel = image_.at(row, column, c);
      pixel += cover * (rgb[static_cast<std::size_t>(c)] / 255.0f - pixel);
    }
  }

  Image image_;
};

}  // namespace

Image to_image(const Scene& scene) {
  Canvas canvas(scene.width, scene.height);
  for (const auto& shape : scene.shapes) std::visit([&](const auto& s) { canvas.draw(s); }, shape);
  return canvas.take();
}

}  // namespace patina
