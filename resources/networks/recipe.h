#pragma once

#include <ATen/core/Tensor.h>

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/sampling/rng.h"

namespace patina {

/// What a render is made from: a place in a material's prior, and irregularities.
struct Recipe {
  std::string material;
  Eigen::VectorXd coordinates;  ///< of the continuous parameters, in which the prior is N(0, I)
  std::vector<int> levels;      ///< of the discrete ones
  std::uint64_t z_seed = 0;
};

/// A draw from the material's prior. @throws UserError for an unknown material
Recipe draw_recipe(const std::string& material, std::uint64_t z_seed, Rng& rng);

/// The renders, in the order of their recipes; each z is made only once.
/// @return  each [3, side, side] float32, sRGB in [0,1]
std::vector<at::Tensor> render_all(const std::vector<Recipe>& recipes, int side);

}  // namespace patina
