#include "engine/material/cell_kernel.h"

#include <cmath>
#include <limits>

#define PATINA_KERNEL "engine/material/cell_kernel.simd.h"
#include "engine/simd/each_target.h"

namespace patina::cells {

void edge_distances(const Points& sites, const Points& points, float* to) {
  PATINA_ON_TARGET(edge_distances(sites, points, to));
}

}  // namespace patina::cells
