// Read once for each target by each_target.h.
namespace patina::flake::PATINA_TARGET {
namespace simd = patina::simd::PATINA_TARGET;

using simd::Lanes;

void lobe(const Gloss& gloss, const ConstPlanes& flakes, std::ptrdiff_t begin, std::ptrdiff_t end,
          const Planes& normal, float* roughness) {
  const float spread = kSpread * gloss.steepness * gloss.steepness;
  for (std::ptrdiff_t i = begin; i < end; i += simd::kLanes) {
    const int count = simd::lanes_from(i, end);
    const Lanes x = simd::load(flakes[0] + i, count) * gloss.steepness,
                y = simd::load(flakes[1] + i, count) * gloss.steepness;
    const Lanes up = 1 / simd::sqrt(x * x + y * y + 1);
    simd::store(x * up, normal[0] + i, count);
    simd::store(y * up, normal[1] + i, count);
    simd::store(up, normal[2] + i, count);
    const Lanes square_alpha = gloss.square_alpha + simd::load(flakes[2] + i, count) * spread;
    simd::store(simd::sqrt(simd::sqrt(square_alpha)), roughness + i, count);
  }
}

void lobe_backward(const Gloss& gloss, const ConstPlanes& flakes, const Lobe& lobe, const Lobe& gradient,
                   std::ptrdiff_t begin, std::ptrdiff_t end, const Planes& by_flakes, double* by_gloss) {
  const float spread = kSpread * gloss.steepness * gloss.steepness;
  Lanes by_steepness{}, by_square_alpha{};
  for (std::ptrdiff_t i = begin; i < end; i += simd::kLanes) {
    const int count = simd::lanes_from(i, end);
    const auto at = [&](const float* plane) __attribute__((always_inline)) {
      return simd::load(plane + i, count);
    };
    const auto by = [&](const float* plane) __attribute__((always_inline)) {
      return simd::load_or_zero(plane + i, count);
    };
    // With slopes s and the normal n = (s, 1) n_z: by s, g_s n_z - (g . n) n_s n_z.
    const Lanes up = at(lobe.normal[2]);
    const Lanes along = by(gradient.normal[0]) * at(lobe.normal[0]) +
                        by(gradient.normal[1]) * at(lobe.normal[1]) + by(gradient.normal[2]) * up;
    for (std::size_t k = 0; k < 2; ++k) {
      const Lanes by_slope = (by(gradient.normal[k]) - along * at(lobe.normal[k])) * up;
      simd::store(by_slope * gloss.steepness, by_flakes[k] + i, count);
      by_steepness += by_slope * at(flakes[k]);
    }
    const Lanes rough = at(lobe.roughness);
    const Lanes by_alpha = by(gradient.roughness) / (4 * rough * rough * rough);
    simd::store(by_alpha * spread, by_flakes[2] + i, count);
    by_steepness += by_alpha * at(flakes[2]) * (2 * kSpread * gloss.steepness);
    by_square_alpha += by_alpha;
  }
  by_gloss[0] += simd::sum(by_steepness);
  by_gloss[1] += simd::sum(by_square_alpha);
}

}  // namespace patina::flake::PATINA_TARGET
