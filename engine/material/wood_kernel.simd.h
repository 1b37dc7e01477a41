// Read once for each target by each_target.h.
#include "engine/material/over_pixels.simd.h"

namespace patina::wood::PATINA_TARGET {
namespace simd = patina::simd::PATINA_TARGET;
namespace {

using simd::Lanes;

/// The least square of a ring's width: a thousandth of a ring keeps the division well-conditioned.
constexpr float kLeastSquare = 1e-6F;
constexpr float kDarkest = 1e-20F;  // whose logarithm and reciprocal are numbers

PATINA_INLINE Lanes clamp(const Lanes& x, const Lanes& high) {
  const Lanes raised = x < 0 ? Lanes{} : x;
  return raised > high ? high : raised;
}

/// The integral of the ratio from the beginning of a ring to t, over the ring's top; how far up the ratio is
/// on either ramp, both from 0 to 1.
struct Reached {
  Lanes area, risen, fallen;
};

PATINA_INLINE Reached reached(const Ring& ring, const Lanes& t) {
  const Lanes risen = t < ring.rise ? t / ring.rise : 1 - Lanes{};
  const Lanes fallen = clamp(t - (ring.end - ring.fall), ring.fall - Lanes{}) / ring.fall;
  const Lanes after = t > ring.end ? t - ring.end : Lanes{};
  return {(risen * risen / 2 - risen) * ring.rise + t - fallen * fallen / 2 * ring.fall - after, risen,
          fallen};
}

/// Where a pixel begins and ends, and what lies between.
struct PixelOfRings {
  Lanes whole_begin, whole_end;  ///< rings before
  Reached begin, end;
  Lanes mean;      ///< of the ratio over the pixel
  Lanes contrast;  ///< share of it in what is seen
  Lanes seen;      ///< before rounding is cut off
};

PATINA_INLINE PixelOfRings pixel_of(const Ring& ring, const Lanes& rings, const Lanes& width) {
  PixelOfRings p;
  const Lanes begin = rings - width / 2;
  const Lanes from = begin - simd::floor(begin), to = from + width;
  p.whole_begin = simd::floor(from);
  p.whole_end = simd::floor(to);
  p.begin = reached(ring, from - p.whole_begin);
  p.end = reached(ring, to - p.whole_end);
  p.mean = ((p.whole_end - p.whole_begin) * ring.mean + (p.end.area - p.begin.area) * ring.top) / width;
  p.contrast = simd::clamp(2 - 2 * width, 0, 1);
  p.seen = ring.mean + (p.mean - ring.mean) * p.contrast;
  return p;
}

/// Calls f(pixel, across, down, count) for all pixels of rows: where the pixels lie, and where the rings that
/// their steps to the next column and to the next row begin at. The last column and row have the steps
/// before.
template <class F>
PATINA_INLINE void over_steps(const RingField& field, std::ptrdiff_t begin, std::ptrdiff_t end, const F& f) {
  const std::ptrdiff_t last = field.columns - 1;
  for (std::ptrdiff_t row = begin; row < end; ++row) {
    const std::ptrdiff_t here = row * field.columns;
    const std::ptrdiff_t down = row < field.rows - 1 ? here : here - field.columns;
    for (std::ptrdiff_t column = 0; column < last; column += simd::kLanes)
      f(here + column, here + column, down + column, simd::lanes_from(column, last));
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

}  // namespace

void latewood_ratio(const Ring& ring, const float* rings, const float* width, std::ptrdiff_t begin,
                    std::ptrdiff_t end, float* ratio) {
  for (std::ptrdiff_t i = begin; i < end; i += simd::kLanes) {
    const int count = simd::lanes_from(i, end);
    const PixelOfRings p = pixel_of(ring, simd::load(rings + i, count), simd::load(width + i, count));
    simd::store(simd::clamp(p.seen, 0, 1), ratio + i, count);
  }
}

void latewood_ratio_backward(const Ring& ring, const float* rings, const float* width, std::ptrdiff_t begin,
                             std::ptrdiff_t end, const float* gradient, float* by_rings, float* by_width,
                             double* by_ring) {
  std::array<Lanes, kRingNumbers> sums{};
  for (std::ptrdiff_t i = begin; i < end; i += simd::kLanes) {
    const int count = simd::lanes_from(i, end);
    const Lanes w = simd::load(width + i, count);
    const PixelOfRings p = pixel_of(ring, simd::load(rings + i, count), w);
    const Lanes given = simd::load_or_zero(gradient + i, count);
    const Lanes by_seen = p.seen > 0 && p.seen < 1 ? given : Lanes{};
    const Lanes by_mean = by_seen * p.contrast, by_integral = by_mean / w;
    const Lanes by_contrast = by_seen * (p.mean - ring.mean);
    // The ratio itself at either end of the pixel.
    const Lanes at_begin = (p.begin.risen - p.begin.fallen) * ring.top,
                at_end = (p.end.risen - p.end.fallen) * ring.top;
    simd::store(by_integral * (at_end - at_begin), by_rings + i, count);
    const Lanes contrast_falls = w > 0.5F && w < 1 ? 2 - Lanes{} : Lanes{};
    simd::store(by_integral * ((at_end + at_begin) / 2 - p.mean) - by_contrast * contrast_falls, by_width + i,
                count);
    const auto half_square = [](const Lanes& x) __attribute__((always_inline)) { return x * x / 2; };
    const Lanes by_area = by_integral * ring.top;
    sums[0] += by_area * (p.end.fallen - p.begin.fallen);
    sums[1] += by_integral * (p.end.area - p.begin.area);
    sums[2] += by_area * (half_square(p.begin.risen) - half_square(p.end.risen));
    sums[3] +=
        by_area * (half_square(p.end.fallen) - p.end.fallen - half_square(p.begin.fallen) + p.begin.fallen);
    sums[4] += by_integral * (p.whole_end - p.whole_begin) + by_seen * (1 - p.contrast);
  }
  for (std::size_t k = 0; k < kRingNumbers; ++k) by_ring[k] += simd::sum(sums[k]);
}

void ring_widths(const RingField& field, std::ptrdiff_t begin, std::ptrdiff_t end, float* width) {
  const float* rings = field.rings;
  over_steps(
      field, begin, end,
      [&](std::ptrdiff_t pixel, std::ptrdiff_t across, std::ptrdiff_t down, int count)
          __attribute__((always_inline)) {
            const Lanes x = simd::load(rings + across + 1, count) - simd::load(rings + across, count);
            const Lanes y = simd::load(rings + down + field.columns, count) - simd::load(rings + down, count);
            simd::store(simd::sqrt(x * x + y * y + kLeastSquare), width + pixel, count);
          });
}

void ring_widths_backward(const RingField& field, const float* width, const float* gradient,
                          float* by_rings) {
  const float* rings = field.rings;
  over_steps(
      field, 0, field.rows,
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

void finish(const Contrast& contrast, const LatewoodField& field, const Grain& grain, std::ptrdiff_t begin,
            std::ptrdiff_t end, const FinishTo& to) {
  const std::ptrdiff_t with_neighbour = field.side + 1;
  for (std::ptrdiff_t i = begin * with_neighbour; i < end * with_neighbour; i += simd::kLanes) {
    const int count = simd::lanes_from(i, end * with_neighbour);
    const Lanes height = simd::load(field.ratio + i, count) * contrast.latewood_height;
    simd::store(height + simd::load(grain.height + i, count) * grain.cm, to.height + i, count);
  }
  simd::over_pixels(
      field.side, begin,
      end, [&](std::ptrdiff_t in_grid, std::ptrdiff_t pixel, int count) __attribute__((always_inline)) {
        const Lanes q = simd::load(field.ratio + in_grid, count),
                    power = simd::load(field.exponent + pixel, count);
        for (std::size_t c = 0; c < 3; ++c) {
          const Lanes mixed = mixture(contrast, c, q);
          simd::store(simd::exp2(simd::clamp(power * simd::log2(mixed), -126, 126)), to.color[c] + pixel,
                      count);
        }
        simd::store(simd::clamp(roughness(contrast, q), 0, 1), to.roughness + pixel, count);
      });
}

void finish_backward(const Contrast& contrast, const LatewoodField& field, const ConstPlanes& color,
                     std::ptrdiff_t begin, std::ptrdiff_t end, const FinishGradient& given,
                     const LatewoodGradient& by) {
  const std::ptrdiff_t with_neighbour = field.side + 1;
  std::array<Lanes, 3> early_sums{}, late_sums{};
  Lanes by_height{}, by_roughness{}, by_more{};
  for (std::ptrdiff_t i = begin * with_neighbour; i < end * with_neighbour; i += simd::kLanes) {
    const int count = simd::lanes_from(i, end * with_neighbour);
    const Lanes by_here = simd::load_or_zero(given.height + i, count);
    simd::store(by_here * contrast.latewood_height, by.ratio + i, count);
    by_height += by_here * simd::load(field.ratio + i, count);
  }
  simd::over_pixels(
      field.side, begin,
      end, [&](std::ptrdiff_t in_grid, std::ptrdiff_t pixel, int count) __attribute__((always_inline)) {
        const Lanes q = simd::load(field.ratio + in_grid, count),
                    power = simd::load(field.exponent + pixel, count);
        Lanes by_q{}, by_power{};
        for (std::size_t c = 0; c < 3; ++c) {
          const Lanes mixed = mixture(contrast, c, q);
          const Lanes by_log =
              simd::load_or_zero(given.color[c] + pixel, count) * simd::load(color[c] + pixel, count);
          by_power += by_log * simd::log2(mixed);
          const Lanes by_mixed = by_log * power / mixed;
          by_q += by_mixed * (contrast.latewood[c] - contrast.earlywood[c]);
          early_sums[c] += by_mixed * (1 - q);
          late_sums[c] += by_mixed * q;
        }
        const Lanes rough = roughness(contrast, q),
                    by_rough =
                        rough > 0 && rough < 1 ? simd::load_or_zero(given.roughness + pixel, count) : Lanes{};
        by_roughness += by_rough;
        by_more += by_rough * (1 - q);
        simd::add(by_q - by_rough * contrast.earlywood_roughness_more, by.ratio + in_grid, count);
        simd::store(by_power * std::numbers::ln2_v<float>, by.exponent + pixel, count);
      });
  for (std::size_t c = 0; c < 3; ++c) {
    by.contrast[c] += simd::sum(early_sums[c]);
    by.contrast[3 + c] += simd::sum(late_sums[c]);
  }
  by.contrast[6] += simd::sum(by_height);
  by.contrast[7] += simd::sum(by_roughness);
  by.contrast[8] += simd::sum(by_more);
}

}  // namespace patina::wood::PATINA_TARGET
