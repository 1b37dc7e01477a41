// Read once for each target by each_target.h.
namespace patina::mip::PATINA_TARGET {
namespace simd = patina::simd::PATINA_TARGET;
namespace {

using simd::Bits;
using simd::Lanes;

/// Texels a half period spans.
PATINA_INLINE float texels(const Level& level) { return 0.5f * static_cast<float>(level.side - 2); }

/// The texel before a place, and how far it is from there to the next.
struct Between {
  Bits first;
  Lanes fraction;
};

/// A place that is no number lies at the border, and stays none in its fraction.
PATINA_INLINE Between between(const Level& level, const Lanes& place) {
  const Lanes at = place * texels(level) + 0.5f;
  const Bits cut = __builtin_convertvector(at, Bits), raised = cut < 0 ? cut - cut : cut;
  const int last = level.side - 2;
  const Bits first = raised > last ? raised - raised + last : raised;
  return {first, at - __builtin_convertvector(first, Lanes)};
}

/// A row of the grid in a level: the texels of the row before it, and how far it is from there to the next.
struct Row {
  const float* before;
  float fraction;
};

PATINA_INLINE Row row_at(const Level& level, float place, int channel) {
  const float at = place * texels(level) + 0.5f;
  const int first = at > 0 ? std::min(static_cast<int>(at), level.side - 2) : 0;
  return {level.values + (static_cast<std::ptrdiff_t>(channel) * level.side + first) * level.side,
          at - static_cast<float>(first)};
}

struct Sample {
  Lanes value, by_column, by_row;  ///< per texel
};

PATINA_INLINE Sample sample(const Level& level, const Row& row, const Between& column) {
  const float *near = row.before, *far = near + level.side;
  const Lanes a = simd::gather(near, column.first), b = simd::gather(near + 1, column.first),
              c = simd::gather(far, column.first), d = simd::gather(far + 1, column.first);
  const Lanes near_slope = b - a, far_slope = d - c;
  const Lanes near_value = a + near_slope * column.fraction, far_value = c + far_slope * column.fraction;
  return {near_value + (far_value - near_value) * row.fraction,
          near_slope + (far_slope - near_slope) * row.fraction, far_value - near_value};
}

PATINA_INLINE int channels_of(const Problem& problem) {
  assert(problem.levels.size() <= kMostLevels && problem.channels <= kMostChannels);
  return std::min(problem.channels, kMostChannels);
}

}  // namespace

void look_up(const Problem& problem, std::ptrdiff_t begin, std::ptrdiff_t end, float* to) {
  const int channels = channels_of(problem);
  const std::ptrdiff_t columns = problem.columns(), plane = columns * problem.rows();
  for (std::ptrdiff_t r = begin; r < end; ++r)
    for (std::ptrdiff_t i = 0; i < columns; i += simd::kLanes) {
      const int count = simd::lanes_from(i, columns);
      const Lanes x = simd::load(problem.x.data() + i, count);
      std::array<Lanes, kMostChannels> sums{};
      for (const Level& level : problem.levels) {
        const Between column = between(level, x);
        for (int c = 0; c < channels; ++c)
          sums[static_cast<std::size_t>(c)] +=
              level.weight *
              sample(level, row_at(level, problem.y[static_cast<std::size_t>(r)], c), column).value;
      }
      for (int c = 0; c < channels; ++c)
        simd::store(sums[static_cast<std::size_t>(c)], to + c * plane + r * columns + i, count);
    }
}

void look_up_backward(const Problem& problem, std::ptrdiff_t begin, std::ptrdiff_t end, const float* by_value,
                      Gradient& gradient) {
  const int channels = channels_of(problem);
  const std::ptrdiff_t columns = problem.columns(), plane = columns * problem.rows();
  std::array<Lanes, kMostLevels> by_weight{};
  for (std::ptrdiff_t r = begin; r < end; ++r) {
    Lanes by_y{};
    for (std::ptrdiff_t i = 0; i < columns; i += simd::kLanes) {
      const int count = simd::lanes_from(i, columns);
      const Lanes x = simd::load(problem.x.data() + i, count);
      Lanes by_x{};
      for (std::size_t l = 0; l < problem.levels.size(); ++l) {
        const Level& level = problem.levels[l];
        const Between column = between(level, x);
        Lanes along_x{}, along_y{};
        for (int c = 0; c < channels; ++c) {
          const Sample s = sample(level, row_at(level, problem.y[static_cast<std::size_t>(r)], c), column);
          const Lanes by = simd::load_or_zero(by_value + c * plane + r * columns + i, count);
          by_weight[l] += by * s.value;
          along_x += by * s.by_column;
          along_y += by * s.by_row;
        }
        by_x += along_x * (level.weight * texels(level));
        by_y += along_y * (level.weight * texels(level));
      }
      float* sum = gradient.x.data() + i;
      simd::store(simd::load(sum, count) + by_x, sum, count);
    }
    gradient.y[r] = static_cast<float>(simd::sum(by_y));
  }
  for (std::size_t l = 0; l < problem.levels.size(); ++l) gradient.weight[l] += simd::sum(by_weight[l]);
}

}  // namespace patina::mip::PATINA_TARGET
