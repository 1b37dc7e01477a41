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

/// @param at  in runs. One that is no number lies at 0, and stays none in its fraction.
PATINA_INLINE Between between(const Lanes& at, int period) {
  const auto width = static_cast<float>(period);
  const Lanes inside = at - simd::floor(at / width) * width;
  const Bits cut = __builtin_convertvector(inside, Bits), raised = cut < 0 ? cut - cut : cut;
  const Bits first = raised >= period ? raised - raised + (period - 1) : raised;
  return {first, inside - __builtin_convertvector(first, Lanes)};
}

/// Linear interpolation, and its slope.
struct Line {
  Lanes value, slope;
};

PATINA_INLINE Line line(const Lanes& left, const Lanes& right, const Lanes& fraction) {
  const Lanes slope = right - left;
  return {left + slope * fraction, slope};
}

struct Sample {
  Lanes value, by_x, by_y;
};

PATINA_INLINE Sample sample(const Plane& plane, const Lanes& x, const Lanes& y) {
  const Between column = between((x - (plane.run_x - 1) / 2) / plane.run_x, plane.columns);
  const Between row = between((y - (plane.run_y - 1) / 2) / plane.run_y, plane.rows);
  const int stride = plane.columns + 1;
  const simd::Places first = simd::places_of(row.first * stride + column.first, plane.rows * stride - 1);
  const float *here = plane.values, *below = here + stride;
  const Line near = line(simd::take(here, first), simd::take(here + 1, first), column.fraction);
  const Line far = line(simd::take(below, first), simd::take(below + 1, first), column.fraction);
  const Line across = line(near.value, far.value, row.fraction);
  return {across.value, (near.slope + (far.slope - near.slope) * row.fraction) / plane.run_x,
          across.slope / plane.run_y};
}

struct VolumeSample {
  Lanes value, by_x, by_y, by_z;
};

/// Where eight neighbours lie, and where between them.
struct Cell {
  Between x, y, z;
  simd::Places first;
};

PATINA_INLINE Cell cell_of(const Volume& volume, const Lanes& x, const Lanes& y, const Lanes& z) {
  Cell cell{between(x, volume.period), between(y, volume.period), between(z, volume.period), {}};
  const int stride = volume.period + 1, furthest = (stride + 1) * stride + 1;
  cell.first = simd::places_of((cell.z.first * stride + cell.y.first) * stride + cell.x.first,
                               stride * stride * stride - furthest);
  return cell;
}

PATINA_INLINE VolumeSample sample(const Volume& volume, const Cell& cell, int channel) {
  const int stride = volume.period + 1;
  const float* values = volume.values + channel * stride * stride * stride;
  const auto along_x = [&](int y, int z) __attribute__((always_inline)) {
    const float* row = values + (z * stride + y) * stride;
    return line(simd::take(row, cell.first), simd::take(row + 1, cell.first), cell.x.fraction);
  };
  struct Face {
    Lanes value, by_x, by_y;
  };
  const auto face = [&](int z) __attribute__((always_inline)) {
    const Line near = along_x(0, z), far = along_x(1, z);
    return Face{near.value + (far.value - near.value) * cell.y.fraction,
                near.slope + (far.slope - near.slope) * cell.y.fraction, far.value - near.value};
  };
  const Face near = face(0), far = face(1);
  const auto mix = [&](const Lanes& a, const Lanes& b) __attribute__((always_inline)) {
    return a + (b - a) * cell.z.fraction;
  };
  return {mix(near.value, far.value), mix(near.by_x, far.by_x), mix(near.by_y, far.by_y),
          far.value - near.value};
}

}  // namespace

void look_up(const std::vector<Plane>& planes, const float* x, const float* y, std::ptrdiff_t begin,
             std::ptrdiff_t end, float* to) {
  for (std::ptrdiff_t i = begin; i < end; i += simd::kLanes) {
    const int count = simd::lanes_from(i, end);
    const Lanes at_x = simd::load(x + i, count), at_y = simd::load(y + i, count);
    Lanes sum{};
    for (const Plane& plane : planes) sum += plane.weight * sample(plane, at_x, at_y).value;
    simd::store(sum, to + i, count);
  }
}

void look_up_backward(const std::vector<Plane>& planes, const float* x, const float* y, std::ptrdiff_t begin,
                      std::ptrdiff_t end, const float* gradient, float* by_x, float* by_y,
                      double* by_weight) {
  assert(planes.size() <= kMostPlanes);
  std::array<Lanes, kMostPlanes> by_weights{};
  for (std::ptrdiff_t i = begin; i < end; i += simd::kLanes) {
    const int count = simd::lanes_from(i, end);
    const Lanes at_x = simd::load(x + i, count), at_y = simd::load(y + i, count),
                by_sum = simd::load_or_zero(gradient + i, count);
    Lanes sum_x{}, sum_y{};
    for (std::size_t p = 0; p < planes.size(); ++p) {
      const Sample s = sample(planes[p], at_x, at_y);
      sum_x += planes[p].weight * s.by_x;
      sum_y += planes[p].weight * s.by_y;
      by_weights[p] += by_sum * s.value;
    }
    simd::store(by_sum * sum_x, by_x + i, count);
    simd::store(by_sum * sum_y, by_y + i, count);
  }
  for (std::size_t p = 0; p < planes.size(); ++p) by_weight[p] += simd::sum(by_weights[p]);
}

void look_up(const Volume& volume, const ConstThree& place, std::ptrdiff_t begin, std::ptrdiff_t end,
             const Two& to) {
  for (std::ptrdiff_t i = begin; i < end; i += simd::kLanes) {
    const int count = simd::lanes_from(i, end);
    const Cell cell = cell_of(volume, simd::load(place[0] + i, count), simd::load(place[1] + i, count),
                              simd::load(place[2] + i, count));
    for (int c = 0; c < 2; ++c)
      simd::store(sample(volume, cell, c).value, to[static_cast<std::size_t>(c)] + i, count);
  }
}

void look_up_backward(const Volume& volume, const ConstThree& place, std::ptrdiff_t begin, std::ptrdiff_t end,
                      const ConstTwo& gradient, const Three& by_place) {
  for (std::ptrdiff_t i = begin; i < end; i += simd::kLanes) {
    const int count = simd::lanes_from(i, end);
    const Cell cell = cell_of(volume, simd::load(place[0] + i, count), simd::load(place[1] + i, count),
                              simd::load(place[2] + i, count));
    Lanes by_x{}, by_y{}, by_z{};
    for (int c = 0; c < 2; ++c) {
      const VolumeSample s = sample(volume, cell, c);
      const Lanes by_value = simd::load_or_zero(gradient[static_cast<std::size_t>(c)] + i, count);
      by_x += by_value * s.by_x;
      by_y += by_value * s.by_y;
      by_z += by_value * s.by_z;
    }
    simd::store(by_x, by_place[0] + i, count);
    simd::store(by_y, by_place[1] + i, count);
    simd::store(by_z, by_place[2] + i, count);
  }
}

}  // namespace patina::noise::PATINA_TARGET
