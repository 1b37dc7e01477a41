#pragma once

#include <cstddef>

/// What a network does between its convolutions, and the adjoint of each, on feature maps whose channels lie
/// together: [rows, columns, channels] float32, dense (channels last).
namespace patina::features {

struct Shape {
  std::ptrdiff_t rows, columns, channels;
  std::ptrdiff_t size() const { return rows * columns * channels; }
};

/// Continues a map by reflection about its border pixels, `border` wide on each side.
/// @param shape  of x; border < rows, columns   @param to  [rows + 2 border, columns + 2 border, channels]
void reflect(const float* x, Shape shape, std::ptrdiff_t border, float* to);
/// @param gradient  by the continued map   @param to  by x; written
void reflect_backward(const float* gradient, Shape shape, std::ptrdiff_t border, float* to);

/// Means of blocks of 2 x 2; an odd last row or column is dropped.
/// @param to  [rows / 2, columns / 2, channels]
void halve(const float* x, Shape shape, float* to);
/// @param shape  of x   @param to  the gradient by x; written
void halve_backward(const float* gradient, Shape shape, float* to);

/// gradient where y > 0, else 0; y = max(x, 0).
void rectify_backward(const float* gradient, const float* y, std::ptrdiff_t size, float* to);

/// Means over the pixels of each channel and of the products of any two. For few channels; a BLAS is better
/// from about 100.
/// @param x  [pixels, channels]   @param means  [channels]   @param products  [channels, channels], symmetric
void moments(const float* x, std::ptrdiff_t pixels, std::ptrdiff_t channels, float* means, float* products);
/// x times a matrix, and a row added to each of its rows.
/// @param matrix  [channels, channels]   @param row  [channels]   @param to  [pixels, channels]
void times(const float* x, std::ptrdiff_t pixels, std::ptrdiff_t channels, const float* matrix,
           const float* row, float* to);

}  // namespace patina::features
