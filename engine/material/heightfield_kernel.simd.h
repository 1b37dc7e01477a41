// Read once for each target by each_target.h.
namespace patina::PATINA_TARGET {
namespace simd = patina::simd::PATINA_TARGET;
namespace {

using simd::Lanes;

/// Pixels of a row that are taken at once: slopes, and one over the length of (-slope_x, -slope_y, 1).
struct Slopes {
  Lanes x, y, inverse_length;
};

/// @param above, here  heights of the row above the pixels and of their own, beginning at their column
PATINA_INLINE Slopes slopes(const float* above, const float* here, float per_pixel, int count) {
  const Lanes height = simd::load(here, count);
  Slopes s;
  s.x = (simd::load(here + 1, count) - height) * per_pixel;
  s.y = (simd::load(above, count) - height) * per_pixel;
  s.inverse_length = 1 / simd::sqrt(s.x * s.x + s.y * s.y + 1);
  return s;
}

}  // namespace

void normals_of_row(const float* above, const float* here, float per_pixel, std::ptrdiff_t n,
                    const Planes& normal) {
  for (std::ptrdiff_t i = 0; i < n; i += simd::kLanes) {
    const int count = simd::lanes_from(i, n);
    const Slopes s = slopes(above + i, here + i, per_pixel, count);
    simd::store(-s.x * s.inverse_length, normal[0] + i, count);
    simd::store(-s.y * s.inverse_length, normal[1] + i, count);
    simd::store(s.inverse_length, normal[2] + i, count);
  }
}

void normals_of_row_backward(const float* above, const float* here, float per_pixel, std::ptrdiff_t n,
                             const ConstPlanes& by_normal, float* by_above, float* by_here) {
  for (std::ptrdiff_t i = 0; i < n; i += simd::kLanes) {
    const int count = simd::lanes_from(i, n);
    const Slopes s = slopes(above + i, here + i, per_pixel, count);
    const Lanes gx = simd::load(by_normal[0] + i, count), gy = simd::load(by_normal[1] + i, count),
                gz = simd::load(by_normal[2] + i, count);
    // What lies along the normal does not turn it.
    const Lanes along = (gz - gx * s.x - gy * s.y) * s.inverse_length * s.inverse_length;
    const Lanes scale = s.inverse_length * per_pixel;
    const Lanes by_rise_x = -(gx + along * s.x) * scale, by_rise_y = -(gy + along * s.y) * scale;
    simd::add(by_rise_y, by_above + i, count);
    simd::add(-(by_rise_x + by_rise_y), by_here + i, count);
    simd::add(by_rise_x, by_here + i + 1, count);
  }
}

}  // namespace patina::PATINA_TARGET
