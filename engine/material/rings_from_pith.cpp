#include "engine/material/rings_from_pith.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/zeros_like.h>

#include <cassert>

#include "engine/material/noise_look_up.h"

namespace patina {
namespace {

/// Of a pixel, in lattice cells.
at::Tensor width_of(const RingGrowth& growth, double pixel_cm) {
  return (growth.scale * pixel_cm).clamp_min(1e-6);
}

}  // namespace

at::Tensor rings_from_pith(const WarpedGrid& place, const RingGrowth& growth, const ValueNoise& noise,
                           double pixel_cm) {
  assert(noise.levels.size() == 1);
  if (place.x.scalar_type() != at::kFloat) return rings_from_pith_by_tensors(place, growth, noise, pixel_cm);
  const at::Tensor width = width_of(growth, pixel_cm);
  return look_up_rings(mixture_of(noise, width, width), place.x, place.y, growth.scale, growth.amplitude,
                       growth.size);
}

at::Tensor rings_from_pith_by_tensors(const WarpedGrid& place, const RingGrowth& growth,
                                      const ValueNoise& noise, double pixel_cm) {
  const at::Tensor radius = (place.x.square() + place.y.square() + 1e-6).sqrt();
  const at::Tensor width = width_of(growth, pixel_cm);
  const at::Tensor lengthening =
      value_noise(noise, growth.scale * radius, at::zeros_like(radius), width, width);
  return (radius + growth.amplitude * lengthening) / growth.size;
}

}  // namespace patina
