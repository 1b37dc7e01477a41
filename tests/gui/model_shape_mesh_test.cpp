#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "gui/preview/shape_mesh.h"

namespace patina {
namespace {

class ShapeMeshTest : public ::testing::TestWithParam<Subject> {
 protected:
  const ShapeMesh mesh_ = shape_mesh(GetParam(), 2);

  /// Twice the triangle's area, along the side that counts as its front.
  static Eigen::Vector3f area(const ShapeMesh& mesh, std::size_t first) {
    const auto corner = [&](std::size_t i) { return mesh.vertices[mesh.indices[first + i]].position; };
    return (corner(1) - corner(0)).cross(corner(2) - corner(0));
  }
};

TEST_P(ShapeMeshTest, EveryVertexHasAFrameThatFitsItsTriangles) {
  for (const ShapeVertex& vertex : mesh_.vertices) {
    EXPECT_NEAR(vertex.normal.norm(), 1, 1e-4);
    EXPECT_NEAR(vertex.tangent.norm(), 1, 1e-4);
    EXPECT_NEAR(vertex.normal.dot(vertex.tangent), 0, 1e-3);
  }
  for (std::size_t i = 0; i < mesh_.indices.size(); i += 3) {
    const Eigen::Vector3f front = area(mesh_, i);
    if (front.norm() < 1e-6f) continue;  // at the poles
    for (std::size_t corner = 0; corner < 3; ++corner)
      EXPECT_GT(front.normalized().dot(mesh_.vertices[mesh_.indices[i + corner]].normal), 0.9f);
  }
}

TEST_P(ShapeMeshTest, TheTangentPointsToWhereTheMapsColumnsGrow) {
  for (std::size_t i = 0; i + 1 < mesh_.vertices.size(); ++i) {
    const ShapeVertex &here = mesh_.vertices[i], &next = mesh_.vertices[i + 1];
    const Eigen::Vector3f step = next.position - here.position;
    const bool same_row = next.place.y() == here.place.y() && next.place.x() > here.place.x();
    if (same_row && step.norm() > 1e-4f) {
      EXPECT_GT(step.normalized().dot(here.tangent), 0.9f) << i;
    }
  }
}

TEST_P(ShapeMeshTest, IsSeenWholeFromTheFirstPlaceOfTheCamera) {
  const Orbit orbit;
  for (const ShapeVertex& vertex : mesh_.vertices) {
    const Eigen::Vector4f clip = orbit.projection() * vertex.position.homogeneous();
    EXPECT_LT(std::abs(clip.x()), clip.w());
    EXPECT_LT(std::abs(clip.y()), clip.w());
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, ShapeMeshTest,
                         ::testing::Values(Subject::plane, Subject::sphere, Subject::cloth),
                         [](const auto& info) {
                           return info.param == Subject::plane    ? "plane"
                                  : info.param == Subject::sphere ? "ball"
                                                                  : "cloth";
                         });

TEST(BallTest, HasTheAreaOfABallAndItsNormalsPointOutwards) {
  const ShapeMesh ball = shape_mesh(Subject::sphere, 1);
  double area = 0;
  for (std::size_t i = 0; i < ball.indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) { return ball.vertices[ball.indices[i + k]].position; };
    area += 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
  }
  EXPECT_NEAR(area, 4 * std::numbers::pi, 0.02);
  for (const ShapeVertex& vertex : ball.vertices) EXPECT_GT(vertex.normal.dot(vertex.position), 0.999f);
}

TEST(BallTest, MirrorImagesMeetAtItsSeam) {
  for (const int copies : {1, 2, 3}) {
    const ShapeMesh ball = shape_mesh(Subject::sphere, copies);
    float most = 0;
    for (const ShapeVertex& vertex : ball.vertices) most = std::max(most, vertex.place.x());
    EXPECT_EQ(static_cast<int>(most) % 2, 0);
    EXPECT_EQ(most, std::round(most));
  }
}

}  // namespace
}  // namespace patina
