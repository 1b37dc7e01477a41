#pragma once

#include <cstddef>

namespace patina::symmetric {

/// The product of a symmetric matrix and a vector: `product` = M x.
/// @param matrix  M, [size, size], column by column; only its lower triangle is read
/// @param x       `size` numbers, as many as `product` has; they do not overlap
void multiply(const double* matrix, const double* x, double* product, std::ptrdiff_t size);

}  // namespace patina::symmetric
