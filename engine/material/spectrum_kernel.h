#pragma once

#include <cstddef>

/// The spectrum of a Gaussian heightfield (gaussian_heightfield.h) in one pass over frequencies, and its
/// gradient.
namespace patina::spectrum {

/// Amplitudes that have one factor an axis, at frequencies and at their negatives; and the phasors there.
struct Problem {
  const float *along_y, *mirrored_y;  ///< [rows]
  const float *along_x,
      *mirrored_x;                  ///< [columns], each frequency twice: for its real and its imaginary part
  const float *phasors, *mirrored;  ///< [rows, columns]
  std::ptrdiff_t columns;
};

/// Rows begin ... end - 1 of along_y along_x phasors + mirrored_y mirrored_x mirrored. @param to  [rows,
/// columns]
void amplitudes(const Problem& problem, std::ptrdiff_t begin, std::ptrdiff_t end, float* to);

struct Gradient {
  float *along_y, *mirrored_y;  ///< [rows]; written
  float *along_x, *mirrored_x;  ///< [columns]; added to
};

/// The gradient of a scalar that rows begin ... end - 1 make, few enough to add up in float32.
/// @param by_amplitudes  the gradient by what amplitudes() writes
void amplitudes_backward(const Problem& problem, std::ptrdiff_t begin, std::ptrdiff_t end,
                         const float* by_amplitudes, const Gradient& gradient);

}  // namespace patina::spectrum
