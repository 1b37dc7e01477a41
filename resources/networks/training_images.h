#pragma once

#include <ATen/core/Tensor.h>

#include <cstdint>
#include <vector>

namespace patina {

/// How many images a family has.
constexpr int kFamilySize = 6;

/// Images to train a network on, in families: a prior draw of a material; the same parameters with another z;
/// a small step away in the same z; a larger one in another z; a variant of the second (image_variants.h);
/// and a threefold variant of the first. So every family holds pairs that should be near, and pairs that are
/// a little apart.
/// @param families  of each material
/// @return  a family's images one after the other, its material's families together
std::vector<at::Tensor> training_images(int families, int side, std::uint64_t seed);

}  // namespace patina
