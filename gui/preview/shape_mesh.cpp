#include "gui/preview/shape_mesh.h"

#include <Eigen/Geometry>
#include <cassert>
#include <cmath>
#include <numbers>

namespace patina {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kFacets = 96;  // a side: facets no longer show

/// A surface over the unit square, (0, 0) at its top left, and how many copies of the maps it bears.
struct Patch {
  Eigen::Vector3d (*point)(double u, double v);
  double copies_across, copies_down;
};

Eigen::Vector3d on_square(double u, double v) { return {2 * u - 1, 1 - 2 * v, 0}; }

Eigen::Vector3d on_ball(double u, double v) {
  const double longitude = 2 * kPi * (u - 0.5), from_pole = kPi * v;
  return {std::sin(from_pole) * std::sin(longitude), std::cos(from_pole),
          std::sin(from_pole) * std::cos(longitude)};
}

/// Gathered at the top, its folds open and drift downwards.
Eigen::Vector3d on_cloth(double u, double v) {
  const double depth = 0.05 + 0.1 * v;
  const double folds = std::sin(2 * kPi * 2.7 * u + 1.2 * std::sin(2.1 * v + 0.6));
  const double drape = std::sin(2 * kPi * (1.1 * u + 0.35 * v) + 1);
  const double width = 1 + 0.12 * v;
  return {width * (2 * u - 1), 1.05 - 2.1 * v, depth * folds + 0.07 * drape};
}

/// The patch's derivative by u or v, central.
Eigen::Vector3d slope(const Patch& patch, double u, double v, double du, double dv) {
  return patch.point(u + du, v + dv) - patch.point(u - du, v - dv);
}

ShapeVertex vertex(const Patch& patch, double u, double v) {
  constexpr double kStep = 1e-4, kOffPole = 1e-3;
  const double inside = std::clamp(v, kOffPole, 1 - kOffPole);  // at a pole there is no tangent
  const Eigen::Vector3d tangent = slope(patch, u, inside, kStep, 0).normalized();
  const Eigen::Vector3d up = slope(patch, u, inside, 0, -kStep);
  const Eigen::Vector3d normal = tangent.cross(up).normalized();
  return {patch.point(u, v).cast<float>(), normal.cast<float>(), tangent.cast<float>(),
          Eigen::Vector2d(patch.copies_across * u, patch.copies_down * v).cast<float>()};
}

ShapeMesh mesh(const Patch& patch) {
  constexpr double kStep = 1.0 / kFacets;
  ShapeMesh mesh;
  for (int row = 0; row <= kFacets; ++row)
    for (int column = 0; column <= kFacets; ++column)
      mesh.vertices.push_back(vertex(patch, column * kStep, row * kStep));
  constexpr std::uint32_t kStride = kFacets + 1;
  for (std::uint32_t row = 0; row < kFacets; ++row)
    for (std::uint32_t column = 0; column < kFacets; ++column) {
      const std::uint32_t corner = row * kStride + column, below = corner + kStride;
      mesh.indices.insert(mesh.indices.end(), {corner, below, corner + 1, corner + 1, below, below + 1});
    }
  return mesh;
}

}  // namespace

ShapeMesh shape_mesh(Subject shape, int copies) {
  assert(is_shape(shape) && copies >= 1);
  const double n = copies;
  switch (shape) {
    case Subject::sphere:
      return mesh({on_ball, 4 * n, 2 * n});
    case Subject::cloth:
      return mesh({on_cloth, n, n});
    default:
      return mesh({on_square, n, n});
  }
}

}  // namespace patina
