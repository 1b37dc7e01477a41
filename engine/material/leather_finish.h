#pragma once

#include <ATen/core/Tensor.h>

namespace patina {

/// What makes leather of its maps (models.md "leather"). Scalars.
struct LeatherRelief {
  at::Tensor height, power;  ///< cm, of cells raised to a power
  at::Tensor noise_scale;    ///< cm
  at::Tensor roughness,
      roughness_variation;  ///< that of the cells' middles, and how much more at their edges
};

struct LeatherFinish {
  at::Tensor height;     ///< [n + 1, n + 1], cm, with neighbours (look_up.h)
  at::Tensor roughness;  ///< [n, n], in [0.1, 0.8]
};

/// @param maps  cells C, nowhere near 0 (cell_map.h), and noise N, both in [0,1]; [2, n + 1, n + 1] with
/// neighbours
/// @return      height clamp(height C^power, 0, 1) + noise_scale (2 N - 1), roughness clamp(roughness + (1 -
/// C)
///              roughness_variation, 0.1, 0.8). In float32 one pass over the pixels, and one for the
///              gradient, which has no further derivatives; else as leather_finish_by_tensors(), the
///              reference
LeatherFinish leather_finish(const LeatherRelief& relief, const at::Tensor& maps);
LeatherFinish leather_finish_by_tensors(const LeatherRelief& relief, const at::Tensor& maps);

}  // namespace patina
