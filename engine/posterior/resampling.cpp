#include "engine/posterior/resampling.h"

#include <ATen/ops/zeros.h>

#include <algorithm>

#include "engine/io/photo.h"

namespace patina {

at::Tensor resampling_matrix(int from, int to) {
  // A grey row with one pixel that is brighter: filters' negative lobes stay within black and white.
  constexpr float kGrey = 0.5, kBrighter = 0.25;
  at::Tensor matrix = at::zeros({to, from}, at::kFloat);
  auto entries = matrix.accessor<float, 2>();
  for (int k = 0; k < from; ++k) {
    Image row(from, 1, 3);
    std::ranges::fill(row.pixels, kGrey);
    for (int c = 0; c < 3; ++c) row.at(0, k, c) += kBrighter;
    const Image response = resized(row, to, 1);
    for (int i = 0; i < to; ++i) entries[i][k] = (response.at(0, i, 0) - kGrey) / kBrighter;
  }
  return matrix;
}

}  // namespace patina
