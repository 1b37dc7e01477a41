#pragma once

#include <ATen/core/Tensor.h>

#include <cstdint>

namespace patina {

/// A periodic Voronoi map of some thousands of cells: least on the edges between cells, rising to 1 inside
/// (models.md, "The maps").
/// @return [1, 1, size, size] in [0.15,1]
at::Tensor make_cell_map(std::uint64_t seed, std::uint64_t stream, int size);

}  // namespace patina
