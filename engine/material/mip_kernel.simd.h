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
    const simd::Places run = simd::places_of(texel, level.side);
    columns.runs.push_back({run.from, run.within});
    std::memcpy(columns.texel.data() + i, &run.index, sizeof run.index);
    simd::store(at - __builtin_convertvector(texel, Lanes), columns.fraction.data() + i, simd::kLanes);
  }
  return columns;
}

/// Where a row of the grid lies in a level: the row of texels before it, how far it is from there to the
/// next, and how far ahead lie the texels of the row that will be wanted then.
struct RowPlace {
  const float* before;  ///< [side] of the first channel, and the next row behind it
  float fraction;
  std::ptrdiff_t to_coming = 0;
};

RowPlace row_in(const Level& level, float place) {
  const float at = place * texels(level) + 0.5f;
  const int first = at > 0 ? std::min(static_cast<int>(at), level.side - 2) : 0;
  return {level.values + static_cast<std::ptrdiff_t>(first) * level.side, at - static_cast<float>(first)};
}

/// Interpolated between four texels, and its slopes per texel.
struct Sample {
  Lanes value, by_x, by_y;
};

/// All columns and one row in a level.
struct Grid {
  const Level* level;
  Columns columns;
  RowPlace row;

  Grid(const Level& of, const std::vector<float>& places)
      : level(&of), columns(columns_in(of, places)), row{} {}

  void set_row(const std::vector<float>& places, std::ptrdiff_t r) {
    const auto here = static_cast<std::size_t>(r), coming = std::min(here + 1, places.size() - 1);
    row = row_in(*level, places[here]);
    row.to_coming = row_in(*level, places[coming]).before - row.before;
  }

  PATINA_INLINE Sample sample(int channel, std::ptrdiff_t i) const {
    const std::ptrdiff_t side = level->side;
    const Columns::Run& run = columns.runs[static_cast<std::size_t>(i / simd::kLanes)];
    simd::Places places{run.from, {}, run.within};
    std::memcpy(&places.index, columns.texel.data() + i, sizeof places.index);
    const float *near = row.before + channel * side * side, *far = near + side;
    // A level is too large to wait for its texels.
    for (const float* coming : {near + row.to_coming + run.from, far + row.to_coming + run.from})
      for (int k = 0; k < simd::kWindow; k += simd::kLanes) __builtin_prefetch(coming + k);
    const Lanes across = simd::load(columns.fraction.data() + i, simd::kLanes);
    const simd::Neighbours above = simd::take(near, places), below = simd::take(far, places);
    const Lanes above_slope = above.next - above.here, below_slope = below.next - below.here;
    const Lanes top = above.here + above_slope * across, down = below.here + below_slope * across - top;
    return {top + down * row.fraction, above_slope + (below_slope - above_slope) * row.fraction, down};
  }
};

std::vector<Grid> grids_of(const Problem& problem) {
  assert(problem.levels.size() <= kMostLevels && problem.channels <= kMostChannels);
  std::vector<Grid> grids;
  for (const Level& level : problem.levels) grids.emplace_back(level, problem.x);
  return grids;
}

}  // namespace

void look_up(const Problem& problem, std::ptrdiff_t begin, std::ptrdiff_t end, float* to) {
  const std::ptrdiff_t columns = problem.columns(), plane = columns * problem.rows();
  std::vector<Grid> grids = grids_of(problem);
  for (std::ptrdiff_t r = begin; r < end; ++r) {
    for (Grid& grid : grids) grid.set_row(problem.y, r);
    for (int c = 0; c < problem.channels; ++c)
      for (std::ptrdiff_t i = 0; i < columns; i += simd::kLanes) {
        Lanes sum{};
        for (const Grid& grid : grids) sum += grid.level->weight * grid.sample(c, i).value;
        simd::store(sum, to + c * plane + r * columns + i, simd::lanes_from(i, columns));
      }
  }
}

void look_up_backward(const Problem& problem, std::ptrdiff_t begin, std::ptrdiff_t end, const float* by_value,
                      Gradient& gradient) {
  const std::ptrdiff_t columns = problem.columns(), plane = columns * problem.rows();
  std::vector<Grid> grids = grids_of(problem);
  std::array<Lanes, kMostLevels> by_weight{};
  for (std::ptrdiff_t r = begin; r < end; ++r) {
    for (Grid& grid : grids) grid.set_row(problem.y, r);
    Lanes by_y{};
    for (std::ptrdiff_t i = 0; i < columns; i += simd::kLanes) {
      const int count = simd::lanes_from(i, columns);
      Lanes by_x{};
      for (std::size_t l = 0; l < grids.size(); ++l) {
        const Level& level = problem.levels[l];
        Lanes along_x{}, along_y{};
        for (int c = 0; c < problem.channels; ++c) {
          const Lanes by = simd::load_or_zero(by_value + c * plane + r * columns + i, count);
          const Sample seen = grids[l].sample(c, i);
          by_weight[l] += by * seen.value;
          along_x += by * seen.by_x;
          along_y += by * seen.by_y;
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
