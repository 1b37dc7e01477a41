#pragma once

#include <Eigen/Core>

namespace patina {

/// A camera that looks at the origin from a sphere around it, y up; at first from +z. A value.
class Orbit {
 public:
  static constexpr float kFieldOfView = 0.5f;  ///< of a square picture, radians
  static constexpr float kNearest = 2.5f, kFurthest = 12;

  void turn(float right, float up);  ///< radians; stops short of the poles
  void approach(float steps);        ///< steps > 0: nearer, by a tenth each

  Eigen::Vector3f eye() const;
  /// From the camera's frame (x to the right, y up, z towards the camera) to the world's.
  Eigen::Matrix3f frame() const;
  /// From world to clip space, OpenGL's.
  Eigen::Matrix4f projection() const;

  bool operator==(const Orbit&) const = default;

 private:
  float yaw_ = 0, pitch_ = 0, distance_ = 4.7f;
};

/// Where a light stands that follows a pointer: over the point of a half ball seen from its front that lies
/// under the pointer, in the camera's frame. @param x,y in [-1, 1] across the picture, y up
Eigen::Vector3f light_under(float x, float y);

}  // namespace patina
