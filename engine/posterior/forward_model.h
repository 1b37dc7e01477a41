#pragma once

#include <ATen/core/Tensor.h>

#include <memory>
#include <span>
#include <vector>

#include "engine/material/material.h"
#include "engine/posterior/camera.h"
#include "engine/posterior/resampling.h"
#include "engine/summary/summary.h"

namespace patina {

/// From parameter values and irregularities to a summary, and to the summary of a photo.
struct ForwardModel {
  std::shared_ptr<const Material> material;
  std::shared_ptr<const Summary> summary;
  Capture capture;
  int resolution = 0;                            ///< pixels a side that are compared
  std::shared_ptr<const Resampling> resampling;  ///< to the resolution

  ForwardModel(std::shared_ptr<const Material> material, std::shared_ptr<const Summary> summary,
               const Capture& capture, int resolution);

  /// Of the render, with its graph; oversampled as its material asks for, and averaged as photos are when
  /// they are resized, in display values. @return [p] float32
  at::Tensor summary_of_render(const ParameterTensors& parameters, const std::vector<int>& discrete,
                               const Irregularities& z) const;

  /// That a camera takes, with Camera::oversampling times the pixels that are compared, or its least side.
  Image photo(const ParameterValues& values, const Irregularities& z, const Camera& camera, Rng& rng) const;

  /// Of photos of one size that photo() has made, in one pass: faster than summary_of(), and the same but for
  /// rounding. @return [photos, p] float32
  at::Tensor summaries_of_photos(std::span<const Image> photos) const;

  /// Of a photo. @param photo  square, sRGB in [0,1], of any resolution
  at::Tensor summary_of(const Image& photo) const;
};

}  // namespace patina
