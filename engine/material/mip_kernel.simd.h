// Read once for each target by each_target.h.
namespace patina::mip::PATINA_TARGET {
namespace simd = patina::simd::PATINA_TARGET;
namespace {

using simd::Bits;
using simd::Lanes;

/// Texels a half period spans.
float texels(const Level& level) { return 0.5f * static_cast<float>(level.side - 2); }

/// Where all columns lie in a level, kLanes after kLanes; the last is repeated until those are full.
struct Columns {
  struct Run {  ///< of simd::Places, whose vector would have to be aligned in memory
    std::ptrdiff_t from;
    simd::Places::Within within;  ///< the table only where the map begins anew
  };
  std::vector<Run> runs;
  std::vector<std::int32_t> texel;  ///< the one before each column, counted from its run's first
  std::vector<float> fraction;      ///< how far it is from there to the next
};

/// A place that is no number lies at the border, and stays none in its fraction.
Columns columns_in(const Level& level, const std::vector<float>& places) {
  const auto count = static_cast<std::ptrdiff_t>(places.size()),
             runs = (count + simd::kLanes - 1) / simd::kLanes;
  const auto whole = static_cast<std::size_t>(runs * simd::kLanes);
  Columns columns{{}, std::vector<std::int32_t>(whole), std::vector<float>(whole)};
  const int last = level.side - 2;
  for (std::ptrdiff_t i = 0; i < count; i += simd::kLanes) {
    const Lanes at = simd::load(places.data() + i, simd::lanes_from(i, count)) * texels(level) + 0.5f;
    const Bits cut = __builtin_convertvector(at, Bits), raised = cut < 0 ? cut - cut : cut;
    const Bits texel = raised > last ? raised - raised + last : raised;
    const simd::Places run = simd::places_of(texel, level.side + simd::kWindow);  // with the line's room
    columns.runs.push_back({run.from, run.within});
    std::memcpy(columns.texel.data() + i, &run.index, sizeof run.index);
    simd::store(at - __builtin_convertvector(texel, Lanes), columns.fraction.data() + i, simd::kLanes);
  }
  return columns;
}

/// Where a row of the grid lies in a level: the row of texels before it, and how far it is to the next.
struct RowPlace {
  const float* before;  ///< [side], and the next row behind it
  float fraction;

  RowPlace(const Level& level, float place, int channel) {
    const float at = place * texels(level) + 0.5f;
    const int first = at > 0 ? std::min(static_cast<int>(at), level.side - 2) : 0;
    before = level.values + (static_cast<std::ptrdiff_t>(channel) * level.side + first) * level.side;
    fraction = at - static_cast<float>(first);
  }
};

/// What lies between two rows of texels at each texel's column, and how that changes from the one to the
/// other.
struct Line {
  std::vector<float> values, slopes;  ///< [side], and room for simd::take()

  /// @param coming  the row that will be wanted next: a level is too large to wait for its texels
  void set(const RowPlace& row, const RowPlace& coming, int side) {
    values.resize(static_cast<std::size_t>(side + simd::kWindow));
    slopes.resize(static_cast<std::size_t>(side + simd::kWindow));
    for (std::ptrdiff_t i = 0; i < side; i += simd::kLanes) {
      __builtin_prefetch(coming.before + i);
      __builtin_prefetch(coming.before + side + i);
      const int count = simd::lanes_from(i, side);
      const Lanes near = simd::load(row.before + i, count),
                  slope = simd::load(row.before + side + i, count) - near;
      simd::store(near + slope * row.fraction, values.data() + i, count);
      simd::store(slope, slopes.data() + i, count);
    }
  }
};

/// Interpolated along a line, and the slope of it, per texel.
struct Sample {
  Lanes value, slope;
};

PATINA_INLINE Sample sample(const std::vector<float>& line, const Columns& columns, std::ptrdiff_t i) {
  const Columns::Run& run = columns.runs[static_cast<std::size_t>(i / simd::kLanes)];
  simd::Places places{run.from, {}, run.within};
  std::memcpy(&places.index, columns.texel.data() + i, sizeof places.index);
  const simd::Neighbours texels = simd::take(line.data(), places);
  const Lanes slope = texels.next - texels.here;
  return {texels.here + slope * simd::load(columns.fraction.data() + i, simd::kLanes), slope};
}

/// The columns in each level, and room for a row's lines: of each channel in each level.
struct Grid {
  std::vector<Columns> columns;
  std::vector<std::vector<Line>> lines;

  explicit Grid(const Problem& problem) {
    assert(problem.levels.size() <= kMostLevels && problem.channels <= kMostChannels);
    for (const Level& level : problem.levels) columns.push_back(columns_in(level, problem.x));
    lines.assign(problem.levels.size(), std::vector<Line>(static_cast<std::size_t>(problem.channels)));
  }

  void set_row(const Problem& problem, std::ptrdiff_t row) {
    const auto here = static_cast<std::size_t>(row), next = std::min(here + 1, problem.y.size() - 1);
    for (std::size_t l = 0; l < problem.levels.size(); ++l)
      for (int c = 0; c < problem.channels; ++c) {
        const Level& level = problem.levels[l];
        lines[l][static_cast<std::size_t>(c)].set({level, problem.y[here], c}, {level, problem.y[next], c},
                                                  level.side);
      }
  }
};

}  // namespace

void look_up(const Problem& problem, std::ptrdiff_t begin, std::ptrdiff_t end, float* to) {
  const std::ptrdiff_t columns = problem.columns(), plane = columns * problem.rows();
  Grid grid(problem);
  for (std::ptrdiff_t r = begin; r < end; ++r) {
    grid.set_row(problem, r);
    for (int c = 0; c < problem.channels; ++c)
      for (std::ptrdiff_t i = 0; i < columns; i += simd::kLanes) {
        Lanes sum{};
        for (std::size_t l = 0; l < problem.levels.size(); ++l)
          sum += problem.levels[l].weight *
                 sample(grid.lines[l][static_cast<std::size_t>(c)].values, grid.columns[l], i).value;
        simd::store(sum, to + c * plane + r * columns + i, simd::lanes_from(i, columns));
      }
  }
}

void look_up_backward(const Problem& problem, std::ptrdiff_t begin, std::ptrdiff_t end, const float* by_value,
                      Gradient& gradient) {
  const std::ptrdiff_t columns = problem.columns(), plane = columns * problem.rows();
  Grid grid(problem);
  std::array<Lanes, kMostLevels> by_weight{};
  for (std::ptrdiff_t r = begin; r < end; ++r) {
    grid.set_row(problem, r);
    Lanes by_y{};
    for (std::ptrdiff_t i = 0; i < columns; i += simd::kLanes) {
      const int count = simd::lanes_from(i, columns);
      Lanes by_x{};
      for (std::size_t l = 0; l < problem.levels.size(); ++l) {
        const Level& level = problem.levels[l];
        Lanes along_x{}, along_y{};
        for (int c = 0; c < problem.channels; ++c) {
          const Line& line = grid.lines[l][static_cast<std::size_t>(c)];
          const Lanes by = simd::load_or_zero(by_value + c * plane + r * columns + i, count);
          const Sample seen = sample(line.values, grid.columns[l], i);
          by_weight[l] += by * seen.value;
          along_x += by * seen.slope;
          along_y += by * sample(line.slopes, grid.columns[l], i).value;
        }
        by_x += along_x * (level.weight * texels(level));
        by_y += along_y * (level.weight * texels(level));
      }
      simd::add(by_x, gradient.x.data() + i, count);
    }
    gradient.y[r] = static_cast<float>(simd::sum(by_y));
  }
  for (std::size_t l = 0; l < problem.levels.size(); ++l) gradient.weight[l] += simd::sum(by_weight[l]);
}

}  // namespace patina::mip::PATINA_TARGET
