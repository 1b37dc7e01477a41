#pragma once

#include <ATen/core/Tensor.h>

namespace patina {

/// What latewood differs in from earlywood (models.md "wood").
struct LatewoodContrast {
  at::Tensor earlywood, latewood;                           ///< colours, [3], linear, above 0
  at::Tensor latewood_height;                               ///< cm; this and what follows scalars
  at::Tensor latewood_roughness, earlywood_roughness_more;  ///< what earlywood's has beyond latewood's
};

/// All that goes with how much of a pixel is latewood.
struct WoodFinish {
  at::Tensor color;      ///< [3, n, n]
  at::Tensor height;     ///< [n + 1, n + 1], cm, with neighbours (look_up.h)
  at::Tensor roughness;  ///< [n, n], in [0,1]
};

/// The colour lies between earlywood's and latewood's, raised to a power that varies with the streaks.
/// @param ratio     of latewood, [n + 1, n + 1] with neighbours, in [0,1]
/// @param exponent  of the colour, [n, n]
/// @param grain     a heightfield that all wood has, [n + 1, n + 1], times `grain_cm`; not differentiated
/// In float32 one pass over the pixels, and one for the gradient, which has no further derivatives; else as
/// wood_finish_by_tensors(), the reference.
WoodFinish wood_finish(const LatewoodContrast& contrast, const at::Tensor& ratio, const at::Tensor& exponent,
                       const at::Tensor& grain, double grain_cm);
WoodFinish wood_finish_by_tensors(const LatewoodContrast& contrast, const at::Tensor& ratio,
                                  const at::Tensor& exponent, const at::Tensor& grain, double grain_cm);

}  // namespace patina
