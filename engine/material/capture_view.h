#pragma once

#include <ATen/core/Tensor.h>

#include "engine/material/capture.h"

namespace patina {

/// What shading needs to know of a capture, per pixel (models.md "Capture"): all that does not depend on a
/// parameter.
struct CaptureView {
  at::Tensor direction;                ///< [3, n, n], unit, from the surface point to camera and light
  at::Tensor inverse_square_distance;  ///< [n, n], 1/cm^2
  at::Tensor square_radius;            ///< [n, n], cm^2 from the sample's centre
  at::Tensor inverse_distance;         ///< [n, n], 1/cm
  at::Tensor offset;                   ///< [n], cm from the sample's centre: x of columns, -y of rows
  double camera_cm;                    ///< above the sample
};

/// The view of an n x n image, kept for the next time unless it is large. Safe to call from several threads.
CaptureView capture_view(const Capture& capture, int resolution, at::ScalarType type);

}  // namespace patina
