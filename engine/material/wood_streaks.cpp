#include "engine/material/wood_streaks.h"

#include <ATen/TensorOperators.h>

#include "engine/material/look_up.h"
#include "engine/material/noise_look_up.h"

namespace patina {

at::Tensor streak_exponent(const WarpedGrid& place, const Streaks& streaks, const ValueNoise& noise,
                           const at::Tensor& width_x, const at::Tensor& width_y) {
  if (place.x.scalar_type() != at::kFloat)
    return streak_exponent_by_tensors(place, streaks, noise, width_x, width_y);
  return look_up_streaks(mixture_of(noise, width_x, width_y), place.x, place.y, streaks.centre_x,
                         streaks.centre_y, streaks.scale, streaks.power);
}

at::Tensor streak_exponent_by_tensors(const WarpedGrid& place, const Streaks& streaks,
                                      const ValueNoise& noise, const at::Tensor& width_x,
                                      const at::Tensor& width_y) {
  const auto across = [&](const at::Tensor& at, const at::Tensor& centre) {
    return (without_neighbours(at) - centre) * streaks.scale;
  };
  const at::Tensor seen = value_noise(noise, across(place.x, streaks.centre_x),
                                      across(place.y, streaks.centre_y), width_x, width_y);
  return streaks.power * seen + 1;
}

}  // namespace patina
