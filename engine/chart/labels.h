#pragma once

#include <vector>

#include "engine/chart/scene.h"

namespace patina {

struct Box {
  double left = 0, top = 0, right = 0, bottom = 0;
};

/// The area that two boxes share.
double overlap(const Box& a, const Box& b);

/// Finds room for names beside points, one after the other.
class LabelPlacer {
 public:
  /// @param area  names stay inside   @param taken  what they had better not cover
  LabelPlacer(const Box& area, std::vector<Box> taken) : area_(area), taken_(std::move(taken)) {}

  /// The place, nearest to the point, where a name covers least.
  Box place(const ScenePoint& point, double width, double height);

 private:
  Box area_;
  std::vector<Box> taken_;
};

}  // namespace patina
