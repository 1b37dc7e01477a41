// Read once for each target by each_target.h.
namespace patina::PATINA_TARGET {
namespace simd = patina::simd::PATINA_TARGET;
namespace {

using simd::Lanes;

/// Pixels of a row that are taken at once: slopes, and one over the length of (-slope_x, -slope_y, 1).
struct Slopes {
  Lanes x, y, inverse_length;
};

/// @param above, here  rows of heights: the row above the pixels and their own, beginning at their column
PATINA_INLINE Slopes slopes(const float* above, const float* here, float per_pixel, int count) {
  const Lanes height = simd::load(here, count);
  Slopes s;
  s.x = (simd::load(here + 1, count) - height) * per_pixel;
  s.y = (simd::load(above, count) - height) * per_pixel;
  s.inverse_length = 1 / simd::sqrt(s.x * s.x + s.y * s.y + 1);
  return s;
}

}  // namespace

void normals_of_rows(const float* height, float per_pixel, std::ptrdiff_t n, std::ptrdiff_t begin,
                     std::ptrdiff_t end, const std::array<float*, 3>& normal) {
  for (std::ptrdiff_t row = begin; row < end; ++row)
    for (std::ptrdiff_t column = 0; column < n; column += simd::kLanes) {
      const int count = simd::lanes_from(column, n);
      const float* above = height + row * (n + 1) + column;
      const Slopes s = slopes(above, above + n + 1, per_pixel, count);
      const std::ptrdiff_t i = row * n + column;
      simd::store(-s.x * s.inverse_length, normal[0] + i, count);
      simd::store(-s.y * s.inverse_length, normal[1] + i, count);
      simd::store(s.inverse_length, normal[2] + i, count);
    }
}

void normals_backward(const float* height, float per_pixel, std::ptrdiff_t n,
                      const std::array<const float*, 3>& normal_gradient, float* height_gradient) {
  for (std::ptrdiff_t row = 0; row < n; ++row)
    for (std::ptrdiff_t column = 0; column < n; column += simd::kLanes) {
      const int count = simd::lanes_from(column, n);
      const std::ptrdiff_t at = row * (n + 1) + column, i = row * n + column;
      const Slopes s = slopes(height + at, height + at + n + 1, per_pixel, count);
      const Lanes gx = simd::load(normal_gradient[0] + i, count),
                  gy = simd::load(normal_gradient[1] + i, count),
                  gz = simd::load(normal_gradient[2] + i, count);
      // What lies along the normal does not turn it.
      const Lanes along = (gz - gx * s.x - gy * s.y) * s.inverse_length * s.inverse_length;
      const Lanes scale = s.inverse_length * per_pixel;
      const Lanes by_rise_x = -(gx + along * s.x) * scale, by_rise_y = -(gy + along * s.y) * scale;
      float* above = height_gradient + at;
      float* here = above + n + 1;
      simd::add(by_rise_y, above, count);
      simd::add(-(by_rise_x + by_rise_y), here, count);
      simd::add(by_rise_x, here + 1, count);
    }
}

}  // namespace patina::PATINA_TARGET
