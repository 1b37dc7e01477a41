#pragma once

namespace patina {

/// The photograph's geometry (models.md "Capture"): a square sample in the plane z = 0, camera and point
/// light both at (0, 0, camera_cm). The defaults make a 46.0 degree square field of view.
struct Capture {
  double size_cm = 21.21;   ///< side of the sample, cm
  double camera_cm = 25.0;  ///< distance of camera and light from its centre, cm
  bool operator==(const Capture&) const = default;
};

/// How radiance in [0,1] becomes a displayed value: the sRGB curve of real photos, or the plain power
/// 1/2.2 of the paper's demo code.
enum class DisplayCurve { srgb, gamma22 };

}  // namespace patina
