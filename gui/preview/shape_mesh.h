#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "gui/preview/preview_view.h"

namespace patina {

/// A point of a shape: where it is, the surface's frame there (the normal away from it, the tangent to where
/// the maps' columns grow), and its place on the maps, one unit a copy of them, rows downwards.
struct ShapeVertex {
  Eigen::Vector3f position, normal, tangent;
  Eigen::Vector2f place;
};

/// Triangles that share their vertices.
struct ShapeMesh {
  std::vector<ShapeVertex> vertices;
  std::vector<std::uint32_t> indices;
};

/// A square, a ball of radius 1 or a hanging cloth, about the origin, its front towards +z.
/// @param copies  of the maps across it, at least 1. Around the ball there are four times as many, so that
///                mirror images meet as well
ShapeMesh shape_mesh(Subject shape, int copies);

}  // namespace patina
