// Read once for each target by each_target.h.
namespace patina::wood::PATINA_TARGET {
namespace simd = patina::simd::PATINA_TARGET;
namespace {

using simd::Lanes;

/// The least square of a ring's width: a thousandth of a ring keeps the division well-conditioned.
constexpr float kLeastSquare = 1e-6F;
constexpr float kDarkest = 1e-12F;  // whose logarithm is a number, and one over the product of three

/// The integral of the ratio from the beginning of a ring to t, over the ring's top; how far up the ratio is
/// on either ramp, both from 0 to 1.
struct Reached {
  Lanes area, risen, fallen;
};

PATINA_INLINE Reached reached(const Ring& ring, const Lanes& t) {
  const Lanes risen = simd::min(1 - Lanes{}, t * (1 / ring.rise));
  const Lanes fallen = simd::clamp((t - (ring.end - ring.fall)) * (1 / ring.fall), 0, 1);
  const Lanes after = simd::max(Lanes{}, t - ring.end);
  return {(risen * risen / 2 - risen) * ring.rise + t - fallen * fallen / 2 * ring.fall - after, risen,
          fallen};
}

/// Where a pixel begins and ends, and what lies between.
struct PixelOfRings {
  Lanes inverse_width;
  Lanes whole_begin, whole_end;  ///< rings before
  Reached begin, end;
  Lanes mean;      ///< of the ratio over the pixel
  Lanes contrast;  ///< share of it in what is seen
  Lanes seen;      ///< before rounding is cut off
};

PATINA_INLINE PixelOfRings pixel_of(const Ring& ring, const Lanes& rings, const Lanes& width) {
  PixelOfRings p;
  p.inverse_width = 1 / width;
  const Lanes begin = rings - width / 2;
  const Lanes from = begin - simd::floor(begin), to = from + width;
  p.whole_begin = simd::floor(from);
  p.whole_end = simd::floor(to);
  p.begin = reached(ring, from - p.whole_begin);
  p.end = reached(ring, to - p.whole_end);
  p.mean =
      ((p.whole_end - p.whole_begin) * ring.mean + (p.end.area - p.begin.area) * ring.top) * p.inverse_width;
  p.contrast = simd::clamp(2 - 2 * width, 0, 1);
  p.seen = ring.mean + (p.mean - ring.mean) * p.contrast;
  return p;
}

/// Calls f(pixel, across, down, count) for all pixels of the first rows: where the pixels lie, and where the
/// rings that their steps to the next column and to the next row begin at. The last column and row of the
/// field have the steps before.
template <class F>
PATINA_INLINE void over_steps(const RingField& field, std::ptrdiff_t rows, const F& f) {
  const std::ptrdiff_t last = field.columns - 1;
  for (std::ptrdiff_t row = 0; row < rows; ++row) {
    const std::ptrdiff_t here = row * field.columns;
    const std::ptrdiff_t down = row < field.rows - 1 ? here : here - field.columns;
    simd::over(
        0, last, [&](std::ptrdiff_t column, int count) __attribute__((always_inline)) {
          f(here + column, here + column, down + column, count);
        });
    f(here + last, here + last - 1, down + last, 1);
  }
}

/// Of a colour's channel, above 0. @param q  ratio of latewood
PATINA_INLINE Lanes mixture(const Contrast& contrast, std::size_t channel, const Lanes& q) {
  const float early = contrast.earlywood[channel];
  return simd::max(kDarkest - Lanes{}, early + q * (contrast.latewood[channel] - early));
}

/// Before it is clamped.
PATINA_INLINE Lanes roughness(const Contrast& contrast, const Lanes& q) {
  return contrast.latewood_roughness + (1 - q) * contrast.earlywood_roughness_more;
}

constexpr std::ptrdiff_t kNoPixel = -1;

/// Calls f(place, pixel, count) for all places of the grid: where they lie, and which pixels they are of.
template <class F>
PATINA_INLINE void over_grid(const Rows& rows, const F& f) {
  for (std::ptrdiff_t row = 0; row < rows.rows; ++row) {
    const std::ptrdiff_t place = row * (rows.side + 1), pixel = (row - rows.first) * rows.side;
    simd::over(
        0, rows.side, [&](std::ptrdiff_t column, int count) __attribute__((always_inline)) {
          f(place + column, row < rows.first ? kNoPixel : pixel + column, count);
        });
    f(place + rows.side, kNoPixel, 1);
  }
}

}  // namespace

void ring_widths(const RingField& field, std::ptrdiff_t rows, float* width) {
  const float* rings = field.rings;
  over_steps(
      field, rows,
      [&](std::ptrdiff_t pixel, std::ptrdiff_t across, std::ptrdiff_t down, int count)
          __attribute__((always_inline)) {
            const Lanes x = simd::load(rings + across + 1, count) - simd::load(rings + across, count);
            const Lanes y = simd::load(rings + down + field.columns, count) - simd::load(rings + down, count);
            simd::store(simd::sqrt(x * x + y * y + kLeastSquare), width + pixel, count);
          });
}

void ring_widths_backward(const RingField& field, std::ptrdiff_t rows, const float* width,
                          const float* gradient, float* by_rings) {
  const float* rings = field.rings;
  over_steps(
      field, rows,
      [&](std::ptrdiff_t pixel, std::ptrdiff_t across, std::ptrdiff_t down, int count)
          __attribute__((always_inline)) {
            const Lanes scale = simd::load(gradient + pixel, count) / simd::load(width + pixel, count);
            const Lanes x = simd::load(rings + across + 1, count) - simd::load(rings + across, count);
            const Lanes y = simd::load(rings + down + field.columns, count) - simd::load(rings + down, count);
            simd::add(-scale * x, by_rings + across, count);
            simd::add(scale * x, by_rings + across + 1, count);
            simd::add(-scale * y, by_rings + down, count);
            simd::add(scale * y, by_rings + down + field.columns, count);
          });
}

void finish(const Ring& ring, const Contrast& contrast, const Rows& rows, const Grain& grain,
            const MapsTo& to) {
  over_grid(
      rows, [&](std::ptrdiff_t place, std::ptrdiff_t pixel, int count) __attribute__((always_inline)) {
        const PixelOfRings p =
            pixel_of(ring, simd::load(rows.rings + place, count), simd::load(rows.width + place, count));
        const Lanes q = simd::clamp(p.seen, 0, 1);
        simd::store(q * contrast.latewood_height + simd::load(grain.height + place, count) * grain.cm,
                    to.height + place, count);
        if (pixel == kNoPixel) return;
        const Lanes power = simd::load(rows.exponent + pixel, count);
        for (std::size_t c = 0; c < 3; ++c) {
          const Lanes mixed = mixture(contrast, c, q);
          simd::store(simd::exp2_of_any(power * simd::log2(mixed)), to.color[c] + pixel, count);
        }
        simd::store(simd::clamp(roughness(contrast, q), 0, 1), to.roughness + pixel, count);
      });
}

void finish_backward(const Ring& ring, const Contrast& contrast, const Rows& rows, const ConstPlanes& color,
                     const MapsGradient& given, const RowsGradient& by) {
  std::array<Lanes, kRingNumbers> ring_sums{};
  std::array<Lanes, kContrastNumbers> contrast_sums{};

  /// The gradient by q of what the pixels show. @return it
  const auto through_pixels = [&](std::ptrdiff_t pixel, const Lanes& q, int count)
      __attribute__((always_inline)) {
    const Lanes power = simd::load(rows.exponent + pixel, count);
    std::array<Lanes, 3> mixed;
    for (std::size_t c = 0; c < 3; ++c) mixed[c] = mixture(contrast, c, q);
    const Lanes quotient = power / (mixed[0] * mixed[1] * mixed[2]);  // three divisions in one
    Lanes by_q{}, by_power{};
    for (std::size_t c = 0; c < 3; ++c) {
      const Lanes by_log =
          simd::load_or_zero(given.color[c] + pixel, count) * simd::load(color[c] + pixel, count);
      by_power += by_log * simd::log2(mixed[c]);
      const Lanes by_mixed = by_log * (mixed[(c + 1) % 3] * mixed[(c + 2) % 3] * quotient);
      by_q += by_mixed * (contrast.latewood[c] - contrast.earlywood[c]);
      contrast_sums[c] += by_mixed * (1 - q);
      contrast_sums[3 + c] += by_mixed * q;
    }
    simd::store(by_power * std::numbers::ln2_v<float>, by.exponent + pixel, count);
    const Lanes rough = roughness(contrast, q);
    const Lanes by_rough =
        rough > 0 && rough < 1 ? simd::load_or_zero(given.roughness + pixel, count) : Lanes{};
    contrast_sums[7] += by_rough;
    contrast_sums[8] += by_rough * (1 - q);
    return by_q - by_rough * contrast.earlywood_roughness_more;
  };

  over_grid(
      rows, [&](std::ptrdiff_t place, std::ptrdiff_t pixel, int count) __attribute__((always_inline)) {
        const Lanes w = simd::load(rows.width + place, count);
        const PixelOfRings p = pixel_of(ring, simd::load(rows.rings + place, count), w);
        const Lanes q = simd::clamp(p.seen, 0, 1),
                    by_height = simd::load_or_zero(given.height + place, count);
        contrast_sums[6] += by_height * q;
        Lanes by_q = by_height * contrast.latewood_height;
        if (pixel != kNoPixel) by_q += through_pixels(pixel, q, count);

        const Lanes by_seen = p.seen > 0 && p.seen < 1 ? by_q : Lanes{};
        const Lanes by_mean = by_seen * p.contrast, by_integral = by_mean * p.inverse_width;
        const Lanes by_contrast = by_seen * (p.mean - ring.mean);
        // The ratio itself at either end of the pixel.
        const Lanes at_begin = (p.begin.risen - p.begin.fallen) * ring.top,
                    at_end = (p.end.risen - p.end.fallen) * ring.top;
        simd::store(by_integral * (at_end - at_begin), by.rings + place, count);
        const Lanes contrast_falls = w > 0.5F && w < 1 ? 2 - Lanes{} : Lanes{};
        simd::store(by_integral * ((at_end + at_begin) / 2 - p.mean) - by_contrast * contrast_falls,
                    by.width + place, count);
        const auto half_square = [](const Lanes& x) __attribute__((always_inline)) { return x * x / 2; };
        const Lanes by_area = by_integral * ring.top;
        ring_sums[0] += by_area * (p.end.fallen - p.begin.fallen);
        ring_sums[1] += by_integral * (p.end.area - p.begin.area);
        ring_sums[2] += by_area * (half_square(p.begin.risen) - half_square(p.end.risen));
        ring_sums[3] += by_area * (half_square(p.end.fallen) - p.end.fallen - half_square(p.begin.fallen) +
                                   p.begin.fallen);
        ring_sums[4] += by_integral * (p.whole_end - p.whole_begin) + by_seen * (1 - p.contrast);
      });
  for (std::size_t k = 0; k < kRingNumbers; ++k) by.ring[k] += simd::sum(ring_sums[k]);
  for (std::size_t k = 0; k < kContrastNumbers; ++k) by.contrast[k] += simd::sum(contrast_sums[k]);
}

}  // namespace patina::wood::PATINA_TARGET
