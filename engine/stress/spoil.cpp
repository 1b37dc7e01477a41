#include "engine/stress/spoil.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "engine/io/photo.h"

namespace patina {
namespace {

double to_linear(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }
double to_srgb(double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }

float in_8_bits(double value) {
  return static_cast<float>(std::round(255 * std::clamp(value, 0.0, 1.0)) / 255);
}

/// A new image from a function of row, column and channel.
Image made(int side, const std::function<double(int, int, int)>& value) {
  Image image(side, side, 3);
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column)
      for (int c = 0; c < 3; ++c) image.at(row, column, c) = in_8_bits(value(row, column, c));
  return image;
}

int inside(int index, int side) { return std::clamp(index, 0, side - 1); }

double bilinear(const Image& image, double row, double column, int channel) {
  const int i = static_cast<int>(std::floor(row)), j = static_cast<int>(std::floor(column));
  const double down = row - i, right = column - j;
  const auto at = [&](int y, int x) {
    return image.at(inside(y, image.height), inside(x, image.width), channel);
  };
  return (1 - down) * ((1 - right) * at(i, j) + right * at(i, j + 1)) +
         down * ((1 - right) * at(i + 1, j) + right * at(i + 1, j + 1));
}

/// Along rows (1, 0) or columns (0, 1), not rounded.
Image blurred_along(const Image& image, double sd, int down, int right) {
  const int reach = static_cast<int>(std::ceil(3 * sd));
  Image result(image.width, image.height, 3);
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column)
      for (int c = 0; c < 3; ++c) {
        double sum = 0, mass = 0;
        for (int k = -reach; k <= reach; ++k) {
          const double weight = std::exp(-0.5 * k * k / (sd * sd));
          sum += weight *
                 image.at(inside(row + k * down, image.height), inside(column + k * right, image.width), c);
          mass += weight;
        }
        result.at(row, column, c) = static_cast<float>(sum / mass);
      }
  return result;
}

}  // namespace

Image exposed(const Image& photo, double r, double g, double b) {
  const double gains[] = {r, g, b};
  return made(photo.width, [&](int row, int column, int c) {
    return to_srgb(gains[c] * to_linear(photo.at(row, column, c)));
  });
}

Image blurred(const Image& photo, double sd) {
  const Image soft = blurred_along(blurred_along(photo, sd, 1, 0), sd, 0, 1);
  return made(photo.width, [&](int row, int column, int c) { return soft.at(row, column, c); });
}

Image sharpened(const Image& photo, double sd, double amount) {
  const Image soft = blurred(photo, sd);
  return made(photo.width, [&](int row, int column, int c) {
    return photo.at(row, column, c) + amount * (photo.at(row, column, c) - soft.at(row, column, c));
  });
}

Image downscaled(const Image& photo, int side) {
  const Image back = resized(resized(photo, side), photo.width);
  return made(photo.width, [&](int row, int column, int c) { return back.at(row, column, c); });
}

Image tilted(const Image& wide, double degrees, int side) {
  constexpr double kDistance = 1.2;
  const double angle = degrees * std::numbers::pi / 180, n = side, middle = 0.5 * wide.width - 0.5;
  return made(side, [&](int row, int column, int c) {
    const double x = (column + 0.5) / n - 0.5, y = (row + 0.5) / n - 0.5;
    // The ray through the pixel meets the plane that is turned about y = 0 at (x s, t): by similar triangles.
    const double t = y * kDistance / (kDistance * std::cos(angle) - y * std::sin(angle));
    const double s = (kDistance + t * std::sin(angle)) / kDistance;
    return bilinear(wide, middle + t * n, middle + x * s * n, c);
  });
}

Image cropped(const Image& photo, int x, int y, int side) {
  return made(side, [&](int row, int column, int c) { return photo.at(row + y, column + x, c); });
}

Image grey(int side, float level) {
  return made(side, [&](int, int, int) { return level; });
}

}  // namespace patina
