// Read once for each target by each_target.h.
namespace patina::glow::PATINA_TARGET {
namespace simd = patina::simd::PATINA_TARGET;
namespace {

using simd::Bits;
using simd::Lanes;

struct Place {
  Bits ring;
  Lanes share;
};

/// Rings lie at nearest + (farthest - nearest) (ring / (kRings - 1))^2 from the beam. The root would make
/// much of what is left where two distances nearly cancel out, and hence their squares are subtracted.
PATINA_INLINE Place place(const Quarter& quarter, const Lanes& square_radius) {
  const float last = quarter.offset[quarter.side - 1], range = quarter.farthest - quarter.nearest;
  const Lanes distance = simd::sqrt(square_radius + static_cast<float>(kBeamRadius * kBeamRadius));
  const Lanes reach = (square_radius - 2 * last * last) / ((distance + quarter.nearest) * range);
  const Lanes at = simd::sqrt(simd::max(reach, Lanes{})) * (kRings - 1);
  const Lanes ring = simd::min(simd::floor(at), kRings - 2 - Lanes{});
  return {__builtin_convertvector(ring, Bits), at - ring};
}

/// Calls f(column, count, squares of distances from the middle).
template <class F>
PATINA_INLINE void over_row(const Quarter& quarter, std::ptrdiff_t row, const F& f) {
  const float y = quarter.offset[row];
  simd::over(
      0, quarter.side, [&](std::ptrdiff_t column, int count) __attribute__((always_inline)) {
        const Lanes x = simd::load(quarter.offset + column, count);
        f(column, count, x * x + y * y);
      });
}

}  // namespace

void places(const Quarter& quarter, std::ptrdiff_t row, std::int32_t* ring, float* share) {
  over_row(
      quarter,
      row, [&](std::ptrdiff_t column, int count, const Lanes& square_radius) __attribute__((always_inline)) {
        const Place at = place(quarter, square_radius);
        simd::store(at.share, share + column, count);
        std::memcpy(ring + column, &at.ring, static_cast<std::size_t>(count) * sizeof(std::int32_t));
      });
}

void colors(const Quarter& quarter, std::ptrdiff_t row, const float* log2_exitance, float* to) {
  over_row(
      quarter,
      row, [&](std::ptrdiff_t column, int count, const Lanes& square_radius) __attribute__((always_inline)) {
        const Place at = place(quarter, square_radius);
        const simd::Neighbours rings = simd::take(log2_exitance, simd::places_of(at.ring, kRings));
        const Lanes exitance = simd::exp2_of_any(rings.here + at.share * (rings.next - rings.here));
        const Lanes square_distance = square_radius + quarter.camera_cm * quarter.camera_cm;
        const Lanes color = exitance * square_distance * simd::sqrt(square_distance) / quarter.camera_cm;
        simd::store(color, to + column, count);
      });
}

void add_rows(const ConstPlanes& planes, std::ptrdiff_t row, std::ptrdiff_t opposite, std::ptrdiff_t width,
              float* to) {
  const float both = row == opposite ? 0 : 1;
  simd::over(
      0, width, [&](std::ptrdiff_t column, int count) __attribute__((always_inline)) {
        Lanes sum{};
        for (const float* plane : planes)
          sum += simd::load(plane + row * width + column, count) +
                 both * simd::load(plane + opposite * width + column, count);
        simd::store(sum, to + column, count);
      });
}

}  // namespace patina::glow::PATINA_TARGET
