#include "engine/chart/labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace patina {
namespace {

/// How much of a box lies outside an area.
double outside(const Box& box, const Box& area) {
  return (box.right - box.left) * (box.bottom - box.top) - overlap(box, area);
}

}  // namespace

double overlap(const Box& a, const Box& b) {
  const double width = std::min(a.right, b.right) - std::max(a.left, b.left);
  const double height = std::min(a.bottom, b.bottom) - std::max(a.top, b.top);
  return width > 0 && height > 0 ? width * height : 0;
}

Box LabelPlacer::place(const ScenePoint& point, double width, double height) {
  constexpr std::array<double, 6> kDistances{9, 14, 22, 32, 46, 64};  // pixels
  constexpr int kDirections = 16;
  // What a name that covers anything costs, and every pixel farther away, in covered pixels.
  constexpr double kCovers = 100, kPerPixel = 1.5;
  Box best;
  double least = INFINITY;
  for (const double distance : kDistances)
    for (int direction = 0; direction < kDirections; ++direction) {
      const double angle = 2 * std::numbers::pi * direction / kDirections;
      const double across = std::cos(angle), down = -std::sin(angle);
      // The box touches a circle around the point from outside.
      const double x = point.x + across * (distance + width / 2),
                   y = point.y + down * (distance + height / 2);
      const Box box{x - width / 2, y - height / 2, x + width / 2, y + height / 2};
      double cost = kPerPixel * distance + 10 * outside(box, area_);
      for (const Box& other : taken_)
        if (const double covered = overlap(box, other); covered > 0) cost += kCovers + covered;
      if (cost >= least) continue;
      least = cost;
      best = box;
    }
  taken_.push_back(best);
  return best;
}

}  // namespace patina
