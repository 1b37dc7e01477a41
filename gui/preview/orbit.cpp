#include "gui/preview/orbit.h"

#include <algorithm>
#include <cmath>

namespace patina {
namespace {

constexpr float kSteepest = 1.5f;     // radians, short of a quarter turn
constexpr float kLowestLight = 0.2f;  // its z: from lower still, a shape would be all shadow

}  // namespace

void Orbit::turn(float right, float up) {
  yaw_ = std::remainder(yaw_ + right, 6.2831853f);
  pitch_ = std::clamp(pitch_ + up, -kSteepest, kSteepest);
}

void Orbit::approach(float steps) {
  distance_ = std::clamp(distance_ * std::pow(0.9f, steps), kNearest, kFurthest);
}

Eigen::Vector3f Orbit::eye() const { return distance_ * frame().col(2); }

Eigen::Matrix3f Orbit::frame() const {
  const float sy = std::sin(yaw_), cy = std::cos(yaw_), sp = std::sin(pitch_), cp = std::cos(pitch_);
  Eigen::Matrix3f frame;
  frame.col(0) = Eigen::Vector3f(cy, 0, -sy);
  frame.col(1) = Eigen::Vector3f(-sp * sy, cp, -sp * cy);
  frame.col(2) = Eigen::Vector3f(cp * sy, sp, cp * cy);
  return frame;
}

Eigen::Matrix4f Orbit::projection() const {
  const float near = 0.1f, far = distance_ + 4, zoom = 1 / std::tan(0.5f * kFieldOfView);
  Eigen::Matrix4f view = Eigen::Matrix4f::Identity();
  view.topLeftCorner<3, 3>() = frame().transpose();
  view(2, 3) = -distance_;
  Eigen::Matrix4f perspective = Eigen::Matrix4f::Zero();
  perspective(0, 0) = perspective(1, 1) = zoom;
  perspective(2, 2) = (far + near) / (near - far);
  perspective(2, 3) = 2 * far * near / (near - far);
  perspective(3, 2) = -1;
  return perspective * view;
}

Eigen::Vector3f light_under(float x, float y) {
  const float most = std::sqrt(1 - kLowestLight * kLowestLight);
  const float shrink = std::min(1.0f, most / std::max(std::hypot(x, y), 1e-6f));
  x *= shrink;
  y *= shrink;
  return {x, y, std::sqrt(1 - x * x - y * y)};
}

}  // namespace patina
