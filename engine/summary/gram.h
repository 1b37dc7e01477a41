#pragma once

#include <ATen/core/Tensor.h>

namespace patina {

/// The Gram matrix of a feature map, G_ij = mean over pixels of F_i F_j (paper equation 4), as a vector: its
/// upper triangle row by row, off-diagonal entries times sqrt 2, so that the vector's norm is G's Frobenius
/// norm.
/// @param features [c, h, w]   @return [c (c + 1) / 2]
at::Tensor gram_vector(const at::Tensor& features);

}  // namespace patina
