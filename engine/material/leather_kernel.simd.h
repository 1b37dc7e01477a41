// Read once for each target by each_target.h.
namespace patina::leather::PATINA_TARGET {
namespace simd = patina::simd::PATINA_TARGET;
namespace {

using simd::Lanes;

constexpr float kDarkest = 1e-20F;  // whose logarithm and reciprocal are numbers

/// C^power, and what it is made of.
struct Raised {
  Lanes cells, log, value;  ///< log to base 2
};

PATINA_INLINE Raised raised(const Relief& relief, const Lanes& cells) {
  const Lanes positive = simd::max(kDarkest - Lanes{}, cells), log = simd::log2(positive);
  return {positive, log, simd::exp2_of_any(log * relief.power)};
}

/// Before it is clamped.
PATINA_INLINE Lanes roughness_at(const Relief& relief, const Lanes& cells) {
  return relief.roughness + (1 - cells) * relief.roughness_variation;
}

/// Calls f(in_grid, pixel, count) for pixels [side, side] that lie in rows begin ... end - 1 of a grid with
/// neighbours (look_up.h), [side + 1, side + 1]: where they are in either.
template <class F>
PATINA_INLINE void over_pixels(std::ptrdiff_t side, std::ptrdiff_t begin, std::ptrdiff_t end, const F& f) {
  for (std::ptrdiff_t row = begin > 0 ? begin : 1; row < end; ++row)
    for (std::ptrdiff_t column = 0; column < side; column += simd::kLanes)
      f(row * (side + 1) + column, (row - 1) * side + column, simd::lanes_from(column, side));
}

}  // namespace

void finish(const Relief& relief, const Maps& maps, std::ptrdiff_t begin, std::ptrdiff_t end, float* height,
            float* roughness) {
  const std::ptrdiff_t last = end * (maps.side + 1);
  for (std::ptrdiff_t i = begin * (maps.side + 1); i < last; i += simd::kLanes) {
    const int count = simd::lanes_from(i, last);
    const Lanes relieved = raised(relief, simd::load(maps.cells + i, count)).value * relief.height;
    const Lanes noise = simd::load(maps.noise + i, count) * 2 - 1;
    simd::store(simd::clamp(relieved, 0, 1) + noise * relief.noise_scale, height + i, count);
  }
  over_pixels(
      maps.side, begin,
      end, [&](std::ptrdiff_t in_grid, std::ptrdiff_t pixel, int count) __attribute__((always_inline)) {
        const Lanes rough = roughness_at(relief, simd::load(maps.cells + in_grid, count));
        simd::store(simd::clamp(rough, kLeastRoughness, kMostRoughness), roughness + pixel, count);
      });
}

void finish_backward(const Relief& relief, const Maps& maps, std::ptrdiff_t begin, std::ptrdiff_t end,
                     const float* by_height, const float* by_roughness, const FinishGradient& by) {
  std::array<Lanes, kReliefNumbers> sums{};
  const std::ptrdiff_t last = end * (maps.side + 1);
  for (std::ptrdiff_t i = begin * (maps.side + 1); i < last; i += simd::kLanes) {
    const int count = simd::lanes_from(i, last);
    const Raised r = raised(relief, simd::load(maps.cells + i, count));
    const Lanes given = simd::load_or_zero(by_height + i, count), relieved = r.value * relief.height;
    const Lanes by_relieved = relieved > 0 && relieved < 1 ? given : Lanes{};
    const Lanes by_log = by_relieved * relieved;  // of C^power
    simd::store(by_log * relief.power / r.cells, by.cells + i, count);
    simd::store(given * (2 * relief.noise_scale), by.noise + i, count);
    sums[0] += by_relieved * r.value;
    sums[1] += by_log * r.log;
    sums[2] += given * (simd::load(maps.noise + i, count) * 2 - 1);
  }
  over_pixels(
      maps.side, begin,
      end, [&](std::ptrdiff_t in_grid, std::ptrdiff_t pixel, int count) __attribute__((always_inline)) {
        const Lanes cells = simd::load(maps.cells + in_grid, count), rough = roughness_at(relief, cells);
        const Lanes by_rough = rough > kLeastRoughness && rough < kMostRoughness
                                   ? simd::load_or_zero(by_roughness + pixel, count)
                                   : Lanes{};
        simd::add(-by_rough * relief.roughness_variation, by.cells + in_grid, count);
        sums[3] += by_rough;
        sums[4] += by_rough * (1 - cells);
      });
  for (std::size_t k = 0; k < kReliefNumbers; ++k)
    by.relief[k] += simd::sum(sums[k]) * (k == 1 ? std::numbers::ln2 : 1);
}

}  // namespace patina::leather::PATINA_TARGET
