// Read once for each target by each_target.h.
namespace patina::spectrum::PATINA_TARGET {
namespace simd = patina::simd::PATINA_TARGET;
using simd::Lanes;

void amplitudes(const Problem& problem, std::ptrdiff_t begin, std::ptrdiff_t end, float* to) {
  for (std::ptrdiff_t row = begin; row < end; ++row) {
    const float y = problem.along_y[row], mirrored_y = problem.mirrored_y[row];
    for (std::ptrdiff_t column = 0; column < problem.columns; column += simd::kLanes) {
      const int count = simd::lanes_from(column, problem.columns);
      const std::ptrdiff_t i = row * problem.columns + column;
      const auto at = [&](const float* x, const float* phasors) __attribute__((always_inline)) {
        return simd::load(x + column, count) * simd::load(phasors + i, count);
      };
      simd::store(
          y * at(problem.along_x, problem.phasors) + mirrored_y * at(problem.mirrored_x, problem.mirrored),
          to + i, count);
    }
  }
}

void amplitudes_backward(const Problem& problem, std::ptrdiff_t begin, std::ptrdiff_t end,
                         const float* by_amplitudes, const Gradient& gradient) {
  for (std::ptrdiff_t row = begin; row < end; ++row) {
    const float y = problem.along_y[row], mirrored_y = problem.mirrored_y[row];
    Lanes by_y{}, by_mirrored_y{};
    for (std::ptrdiff_t column = 0; column < problem.columns; column += simd::kLanes) {
      const int count = simd::lanes_from(column, problem.columns);
      const std::ptrdiff_t i = row * problem.columns + column;
      const Lanes given = simd::load_or_zero(by_amplitudes + i, count);
      const Lanes along = given * simd::load(problem.phasors + i, count),
                  mirrored = given * simd::load(problem.mirrored + i, count);
      by_y += along * simd::load(problem.along_x + column, count);
      by_mirrored_y += mirrored * simd::load(problem.mirrored_x + column, count);
      simd::add(y * along, gradient.along_x + column, count);
      simd::add(mirrored_y * mirrored, gradient.mirrored_x + column, count);
    }
    gradient.along_y[row] = static_cast<float>(simd::sum(by_y));
    gradient.mirrored_y[row] = static_cast<float>(simd::sum(by_mirrored_y));
  }
}

}  // namespace patina::spectrum::PATINA_TARGET
