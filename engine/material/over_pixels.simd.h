// For kernels, once for each target of each_target.h, hence without a guard.
namespace patina::simd::PATINA_TARGET {

/// Calls f(in_grid, pixel, count) for pixels [side, side] that lie in rows begin ... end - 1 of a grid with
/// neighbours (look_up.h), [side + 1, side + 1]: where they are in either.
template <class F>
PATINA_INLINE void over_pixels(std::ptrdiff_t side, std::ptrdiff_t begin, std::ptrdiff_t end, const F& f) {
  for (std::ptrdiff_t row = begin > 0 ? begin : 1; row < end; ++row)
    for (std::ptrdiff_t column = 0; column < side; column += kLanes)
      f(row * (side + 1) + column, (row - 1) * side + column, lanes_from(column, side));
}

}  // namespace patina::simd::PATINA_TARGET
