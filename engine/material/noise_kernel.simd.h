// Read once for each target by each_target.h.
namespace patina::noise::PATINA_TARGET {
namespace simd = patina::simd::PATINA_TARGET;
namespace {

using simd::Bits;
using simd::Lanes;

/// Which two neighbours of an axis a coordinate lies between, and where.
struct Between {
  Bits first;
  Lanes fraction;
};

/// @param at  coordinates. One that is no number lies at 0, and stays none in its fraction.
PATINA_INLINE Between between(const Lanes& at, const Axis& axis) {
  const Lanes in_values = at * axis.per_coordinate - (1 - axis.per_coordinate) / 2;
  const Lanes whole = simd::floor(in_values);
  return {__builtin_convertvector(whole, Bits) & (axis.period - 1), in_values - whole};
}

/// Linear interpolation, and its slope.
struct Line {
  Lanes value, slope;
};

PATINA_INLINE Line line(const simd::Neighbours& ends, const Lanes& fraction) {
  const Lanes slope = ends.next - ends.here;
  return {ends.here + slope * fraction, slope};
}

struct Sample {
  Lanes value, by_x, by_y;
};

PATINA_INLINE Sample sample(const Plane& plane, const Lanes& x, const Lanes& y) {
  const Between column = between(x, plane.x), row = between(y, plane.y);
  const int stride = plane.x.period + 1;
  const simd::Places first = simd::places_of(row.first * stride + column.first, plane.y.period * stride);
  const Line near = line(simd::take(plane.values, first), column.fraction);
  const Line far = line(simd::take(plane.values + stride, first), column.fraction);
  const Line across = line({near.value, far.value}, row.fraction);
  return {across.value, (near.slope + (far.slope - near.slope) * row.fraction) * plane.x.per_coordinate,
          across.slope * plane.y.per_coordinate};
}

/// A plane of one row.
PATINA_INLINE Line sample(const Plane& plane, const Lanes& x) {
  const Between column = between(x, plane.x);
  const Line seen = line(simd::take(plane.values, simd::places_of(column.first, 2 * (plane.x.period + 1))),
                         column.fraction);
  return {seen.value, seen.slope * plane.x.per_coordinate};
}

PATINA_INLINE Lanes radius(const Lanes& x, const Lanes& y) {
  return simd::sqrt(x * x + y * y + Rings::kLeastSquare);
}

/// What a row of the grid meets of a channel: its values at each x of the lattice, and how they change along
/// y and z.
struct VolumeLine {
  std::vector<float> values, by_y, by_z;  ///< [period + 1], and room for simd::take()

  /// @param y, z  of the row, in every lane
  void set(const Volume& volume, int channel, const Between& y, const Between& z) {
    const int side = volume.period + 1;
    for (std::vector<float>* line : {&values, &by_y, &by_z})
      line->resize(static_cast<std::size_t>(side + simd::kWindow));
    const float* near = volume.values + ((channel * side + z.first[0]) * side + y.first[0]) * side;
    const float* far = near + side * side;
    simd::over(
        0, side, [&](std::ptrdiff_t x, int count) __attribute__((always_inline)) {
          const auto along_y = [&](const float* row) __attribute__((always_inline)) {
            return line({simd::load(row + x, count), simd::load(row + side + x, count)}, y.fraction);
          };
          const Line here = along_y(near), there = along_y(far);
          simd::store(here.value + (there.value - here.value) * z.fraction, values.data() + x, count);
          simd::store(here.slope + (there.slope - here.slope) * z.fraction, by_y.data() + x, count);
          simd::store(there.value - here.value, by_z.data() + x, count);
        });
  }
};

/// Which of a line's values pixels lie between, and where.
struct AlongLine {
  simd::Places places;
  Lanes fraction;

  PATINA_INLINE AlongLine(const Lanes& at, int period) {
    const Between x = between(at, {period, 1});
    places = simd::places_of(x.first, period + 1 + simd::kWindow);
    fraction = x.fraction;
  }

  PATINA_INLINE Line operator()(const std::vector<float>& values) const {
    return line(simd::take(values.data(), places), fraction);
  }
};

/// A row's lines, of either channel.
struct VolumeLines {
  std::array<VolumeLine, 2> lines;

  void set_row(const Warp& warp, std::ptrdiff_t row) {
    const auto at = [&](float coordinate) {
      return between(coordinate * warp.scale - Lanes{}, {warp.volume.period, 1});
    };
    const Between y = at(warp.y[row]), z = at(warp.z[row]);
    for (int c = 0; c < 2; ++c) lines[static_cast<std::size_t>(c)].set(warp.volume, c, y, z);
  }
};

}  // namespace

void rings(const Rings& rings, std::ptrdiff_t pixels, float* to) {
  const float per_ring = 1 / rings.size;
  for (std::ptrdiff_t i = 0; i < pixels; i += simd::kLanes) {
    const int count = simd::lanes_from(i, pixels);
    const Lanes r = radius(simd::load(rings.x + i, count), simd::load(rings.y + i, count));
    Lanes noise{};
    for (const Plane& plane : rings.planes) noise += plane.weight * sample(plane, r * rings.scale).value;
    simd::store((r + noise * rings.amplitude) * per_ring, to + i, count);
  }
}

void rings_backward(const Rings& rings, std::ptrdiff_t pixels, const float* gradient,
                    const RingsGradient& by) {
  assert(rings.planes.size() <= kMostPlanes);
  const float steepness = rings.amplitude * rings.scale, per_ring = 1 / rings.size;
  std::array<Lanes, kGrowthNumbers> by_growth{};
  std::array<Lanes, kMostPlanes> by_weights{};
  for (std::ptrdiff_t i = 0; i < pixels; i += simd::kLanes) {
    const int count = simd::lanes_from(i, pixels);
    const Lanes x = simd::load(rings.x + i, count), y = simd::load(rings.y + i, count), r = radius(x, y);
    const Lanes by_grown = simd::load_or_zero(gradient + i, count) * per_ring;
    Lanes noise{}, slope{};
    for (std::size_t p = 0; p < rings.planes.size(); ++p) {
      const Line seen = sample(rings.planes[p], r * rings.scale);
      noise += rings.planes[p].weight * seen.value;
      slope += rings.planes[p].weight * seen.slope;
      by_weights[p] += by_grown * seen.value;
    }
    const Lanes outwards = by_grown * (1 + slope * steepness) / r;
    simd::add(outwards * x, by.x + i, count);
    simd::add(outwards * y, by.y + i, count);
    by_growth[0] += by_grown * slope * r;
    by_growth[1] += by_grown * noise;
    by_growth[2] -= by_grown * (r + noise * rings.amplitude);
  }
  by.growth[0] += simd::sum(by_growth[0]) * rings.amplitude;
  by.growth[1] += simd::sum(by_growth[1]);
  by.growth[2] += simd::sum(by_growth[2]) / rings.size;
  for (std::size_t p = 0; p < rings.planes.size(); ++p)
    by.weights[p] += simd::sum(by_weights[p]) * rings.amplitude;
}

void streaks(const Streaks& streaks, std::ptrdiff_t rows, float* to) {
  for (std::ptrdiff_t row = 0; row < rows; ++row) {
    const std::ptrdiff_t in_grid = row * (streaks.side + 1);
    for (std::ptrdiff_t i = 0; i < streaks.side; i += simd::kLanes) {
      const int count = simd::lanes_from(i, streaks.side);
      const Lanes x = (simd::load(streaks.x + in_grid + i, count) - streaks.centre_x) * streaks.scale,
                  y = (simd::load(streaks.y + in_grid + i, count) - streaks.centre_y) * streaks.scale;
      Lanes noise{};
      for (const Plane& plane : streaks.planes) noise += plane.weight * sample(plane, x, y).value;
      simd::store(1 + noise * streaks.power, to + row * streaks.side + i, count);
    }
  }
}

void streaks_backward(const Streaks& streaks, std::ptrdiff_t rows, const float* gradient,
                      const StreaksGradient& by) {
  assert(streaks.planes.size() <= kMostPlanes);
  const float steepness = streaks.power * streaks.scale;
  std::array<Lanes, kStreakNumbers> sums{};
  std::array<Lanes, kMostPlanes> by_weights{};
  for (std::ptrdiff_t row = 0; row < rows; ++row) {
    const std::ptrdiff_t in_grid = row * (streaks.side + 1);
    for (std::ptrdiff_t i = 0; i < streaks.side; i += simd::kLanes) {
      const int count = simd::lanes_from(i, streaks.side);
      const Lanes x = simd::load(streaks.x + in_grid + i, count) - streaks.centre_x,
                  y = simd::load(streaks.y + in_grid + i, count) - streaks.centre_y,
                  given = simd::load_or_zero(gradient + row * streaks.side + i, count);
      Lanes noise{}, slope_x{}, slope_y{};
      for (std::size_t p = 0; p < streaks.planes.size(); ++p) {
        const Plane& plane = streaks.planes[p];
        const Sample seen = sample(plane, x * streaks.scale, y * streaks.scale);
        noise += plane.weight * seen.value;
        slope_x += plane.weight * seen.by_x;
        slope_y += plane.weight * seen.by_y;
        by_weights[p] += given * seen.value;
      }
      const Lanes by_x = given * slope_x * steepness, by_y = given * slope_y * steepness;
      simd::add(by_x, by.x + in_grid + i, count);
      simd::add(by_y, by.y + in_grid + i, count);
      sums[0] -= by_x;
      sums[1] -= by_y;
      sums[2] += given * (slope_x * x + slope_y * y);
      sums[3] += given * noise;
    }
  }
  by.numbers[0] += simd::sum(sums[0]);
  by.numbers[1] += simd::sum(sums[1]);
  by.numbers[2] += simd::sum(sums[2]) * streaks.power;
  by.numbers[3] += simd::sum(sums[3]);
  for (std::size_t p = 0; p < streaks.planes.size(); ++p)
    by.weights[p] += simd::sum(by_weights[p]) * streaks.power;
}

void warp(const Warp& warp, std::ptrdiff_t rows, const Two& to) {
  VolumeLines line;
  for (std::ptrdiff_t r = 0; r < rows; ++r) {
    line.set_row(warp, r);
    for (std::ptrdiff_t i = 0; i < warp.columns; i += simd::kLanes) {
      const int count = simd::lanes_from(i, warp.columns);
      const Lanes x = simd::load(warp.x + i, count);
      const AlongLine along(x * warp.scale, warp.volume.period);
      const Lanes moved_x = x + along(line.lines[0].values).value * warp.amplitude,
                  moved_y = warp.y[r] + along(line.lines[1].values).value * warp.amplitude;
      simd::store(moved_x, to[0] + r * warp.columns + i, count);
      simd::store(moved_y, to[1] + r * warp.columns + i, count);
    }
  }
}

void warp_backward(const Warp& warp, std::ptrdiff_t rows, const ConstTwo& gradient, const WarpGradient& by) {
  const float steepness = warp.amplitude * warp.scale;
  VolumeLines line;
  Lanes by_scale{}, by_amplitude{};
  for (std::ptrdiff_t r = 0; r < rows; ++r) {
    line.set_row(warp, r);
    Lanes by_y{}, by_z{};
    for (std::ptrdiff_t i = 0; i < warp.columns; i += simd::kLanes) {
      const int count = simd::lanes_from(i, warp.columns);
      const Lanes x = simd::load(warp.x + i, count);
      const AlongLine along(x * warp.scale, warp.volume.period);
      std::array<Lanes, 2> given;
      Lanes along_x{}, along_y{}, along_z{};
      for (std::size_t c = 0; c < 2; ++c) {
        given[c] = simd::load_or_zero(gradient[c] + r * warp.columns + i, count);
        const Line seen = along(line.lines[c].values);
        by_amplitude += given[c] * seen.value;
        along_x += given[c] * seen.slope;
        along_y += given[c] * along(line.lines[c].by_y).value;
        along_z += given[c] * along(line.lines[c].by_z).value;
      }
      by_scale += along_x * x + along_y * warp.y[r] + along_z * warp.z[r];
      simd::add(given[0] + along_x * steepness, by.x + i, count);
      by_y += given[1] + along_y * steepness;
      by_z += along_z * steepness;
    }
    by.y[r] = static_cast<float>(simd::sum(by_y));
    by.z[r] = static_cast<float>(simd::sum(by_z));
  }
  by.scalars[0] += simd::sum(by_scale) * warp.amplitude;
  by.scalars[1] += simd::sum(by_amplitude);
}

}  // namespace patina::noise::PATINA_TARGET
