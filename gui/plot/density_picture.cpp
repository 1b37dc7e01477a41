#include "gui/plot/density_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "gui/window/theme.h"

namespace patina {
namespace {

using Rgb = std::array<float, 3>;  // 0 to 255

constexpr Rgb kDimmed{112, 116, 120};
constexpr float kDimmedOpacity = 0.4f;
constexpr float kLeastOpacity = 0.35f;  // of a cell with one point, where the colour does not tell how many

/// Every cell and a share of its neighbours, as a quadratic B-spline has them at the cells' middles.
Image smoothed(const Image& cells) {
  const auto pass = [](const Image& from, std::size_t count, std::size_t stride, std::size_t lines,
                       std::size_t line_stride) {
    Image to(from.width, from.height, from.channels);
    const auto channels = static_cast<std::size_t>(from.channels);
    for (std::size_t line = 0; line < lines; ++line) {
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = line * line_stride + i * stride;
        const std::size_t before = i > 0 ? at - stride : at, after = i + 1 < count ? at + stride : at;
        for (std::size_t c = 0; c < channels; ++c) {
          to.pixels[at + c] =
              0.75f * from.pixels[at + c] + 0.125f * (from.pixels[before + c] + from.pixels[after + c]);
        }
      }
    }
    return to;
  };
  const auto channels = static_cast<std::size_t>(cells.channels);
  const auto width = static_cast<std::size_t>(cells.width), height = static_cast<std::size_t>(cells.height);
  const Image across = pass(cells, width, channels, height, width * channels);
  return pass(across, height, width * channels, width, channels);
}

Rgb rgb_of(ImU32 color) {
  return {static_cast<float>(color & 0xff), static_cast<float>(color >> 8 & 0xff),
          static_cast<float>(color >> 16 & 0xff)};
}

std::uint8_t byte(float value) { return static_cast<std::uint8_t>(std::clamp(value + 0.5f, 0.0f, 255.0f)); }

}  // namespace

std::vector<std::uint8_t> density_picture(const DensityCells& cells, DensityColours colours) {
  const Image sums = smoothed(cells.sums), dimmed = smoothed(cells.dimmed);
  const float scale = 1 / std::log1p(static_cast<float>(std::max(cells.peak, 1u)));
  std::vector<std::uint8_t> picture(4 * dimmed.pixels.size());
  for (std::size_t cell = 0; cell < dimmed.pixels.size(); ++cell) {
    const float* sum = &sums.pixels[4 * cell];
    const float count = sum[3], beneath = kDimmedOpacity * std::min(1.0f, 2 * dimmed.pixels[cell]);
    if (count <= 0 && beneath <= 0) continue;
    // A lone point is seen as a soft dot.
    const float height = std::min(1.0f, scale * std::log1p(count)), presence = std::min(1.0f, 2 * count);
    Rgb color{};
    float opacity = presence;
    if (colours == DensityColours::count) {
      color = rgb_of(theme::ramp_color(height));
    } else if (count > 0) {
      color = {sum[0] / count, sum[1] / count, sum[2] / count};
      opacity *= std::lerp(kLeastOpacity, 1.0f, height);
    }
    const float seen = beneath * (1 - opacity);
    for (std::size_t c = 0; c < 3; ++c) picture[4 * cell + c] = byte(opacity * color[c] + seen * kDimmed[c]);
    picture[4 * cell + 3] = byte(255 * (opacity + seen));
  }
  return picture;
}

}  // namespace patina
