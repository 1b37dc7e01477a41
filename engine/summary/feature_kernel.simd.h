// Read once for each target by each_target.h.
namespace patina::features::PATINA_TARGET {
namespace simd = patina::simd::PATINA_TARGET;
namespace {

/// Where position i of a line of n, continued by reflection, comes from.
std::ptrdiff_t source(std::ptrdiff_t i, std::ptrdiff_t n) {
  const std::ptrdiff_t low = i < 0 ? -i : i;
  return low < n ? low : 2 * (n - 1) - low;
}

PATINA_INLINE void add(const float* from, std::ptrdiff_t count, float* to) {
  for (std::ptrdiff_t i = 0; i < count; ++i) to[i] += from[i];
}

constexpr int kRows = 8;                                // of a product, in registers together
constexpr int kProducts = PATINA_LANES == 16 ? 16 : 8;  // with other channels; a processor has twice as many
constexpr std::ptrdiff_t kBlock = 512;                  // pixels that are added up in float32

/// kLanes numbers from a place in a map, or as many as are left of it. Those that belong to the next pixel
/// do no harm to who ignores them, and reading them is faster than stopping before.
PATINA_INLINE simd::Lanes load_along(const float* from, const float* end) {
  const std::ptrdiff_t left = end - from;
  return left >= simd::kLanes ? simd::load(from, simd::kLanes)
                              : simd::load_or_zero(from, static_cast<int>(left));
}

/// Adds to kLanes of `to`, as many as there are. Through memory: lanes asked for one by one would keep a loop
/// before from leaving its sums in registers.
PATINA_INLINE void add_to(const simd::Lanes& sum, int count, double* to) {
  float lanes[simd::kLanes];
  simd::store(sum, lanes, simd::kLanes);
  for (int k = 0; k < count; ++k) to[k] += static_cast<double>(lanes[k]);
}

/// Adds kLanes channels from j on up over pixels, and their products with `rows` channels from i on.
template <int rows>
PATINA_INLINE void add_moments(const float* x, std::ptrdiff_t pixels, std::ptrdiff_t channels,
                               std::ptrdiff_t i, std::ptrdiff_t j, const float* end, double* means,
                               double* products) {
  simd::Lanes sums[rows] = {}, sum{};
  for (const float* pixel = x; pixel < x + pixels * channels; pixel += channels) {
    const simd::Lanes right = load_along(pixel + j, end);
    sum += right;
#pragma GCC unroll 16
    for (int r = 0; r < rows; ++r) sums[r] += pixel[i + r] * right;
  }
  const int count = simd::lanes_from(j, channels);
  if (i == 0) add_to(sum, count, means + j);
#pragma GCC unroll 16
  for (int r = 0; r < rows; ++r) add_to(sums[r], count, products + (i + r) * channels + j);
}

// Where a plane's neighbours lie in two vectors of it.
#if PATINA_LANES == 16
constexpr simd::Bits kEven{0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30},
    kLowTwice{0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7};
#elif PATINA_LANES == 8
constexpr simd::Bits kEven{0, 2, 4, 6, 8, 10, 12, 14}, kLowTwice{0, 0, 1, 1, 2, 2, 3, 3};
#else
constexpr simd::Bits kEven{0, 2, 4, 6}, kLowTwice{0, 0, 1, 1};
#endif

/// halve() of a single channel.
void halve_plane(const float* x, Shape shape, float* to) {
  for (std::ptrdiff_t row = 0; row < shape.rows / 2; ++row) {
    const float *upper = x + 2 * row * shape.columns, *lower = upper + shape.columns;
    float* half = to + row * (shape.columns / 2);
    simd::over(
        0, shape.columns / 2, [&](std::ptrdiff_t column, int count) __attribute__((always_inline)) {
          const auto pair = [&](std::ptrdiff_t from) __attribute__((always_inline)) {
            const int left = simd::lanes_from(from, shape.columns);
            return simd::load_or_zero(upper + from, left) + simd::load_or_zero(lower + from, left);
          };
          const simd::Lanes first = pair(2 * column);
          const simd::Lanes second =
              2 * column + simd::kLanes < shape.columns ? pair(2 * column + simd::kLanes) : simd::Lanes{};
          simd::store(
              0.25f * (__builtin_shuffle(first, second, kEven) + __builtin_shuffle(first, second, kEven + 1)),
              half + column, count);
        });
  }
}

/// One row of halve_backward() of a single channel. @param from  [columns / 2]
PATINA_INLINE void double_row(const float* from, std::ptrdiff_t columns, float* to) {
  const std::ptrdiff_t half = columns / 2;
  simd::over(
      0, half, [&](std::ptrdiff_t column, int count) __attribute__((always_inline)) {
        const simd::Lanes quarter = 0.25f * simd::load(from + column, count);
        const std::ptrdiff_t first = 2 * column, second = first + simd::kLanes;
        simd::store(__builtin_shuffle(quarter, kLowTwice), to + first, simd::lanes_from(first, 2 * half));
        if (second < 2 * half)
          simd::store(__builtin_shuffle(quarter, kLowTwice + simd::kLanes / 2), to + second,
                      simd::lanes_from(second, 2 * half));
      });
  if (columns % 2 == 1) to[columns - 1] = 0;
}

}  // namespace

void moments(const float* x, std::ptrdiff_t pixels, std::ptrdiff_t channels, float* means, float* products) {
  std::vector<double> sums(static_cast<std::size_t>(channels * channels)),
      totals(static_cast<std::size_t>(channels));
  const float* end = x + pixels * channels;
  for (std::ptrdiff_t begin = 0; begin < pixels; begin += kBlock)
    for (std::ptrdiff_t j = 0; j < channels; j += simd::kLanes) {
      const float* from = x + begin * channels;
      const std::ptrdiff_t some = std::min(pixels - begin, kBlock),
                           last = std::min(channels, j + simd::kLanes);
      std::ptrdiff_t i = 0;  // the upper triangle, and what else is in its squares
      for (; i + kProducts <= last; i += kProducts)
        add_moments<kProducts>(from, some, channels, i, j, end, totals.data(), sums.data());
      for (; i < last; ++i) add_moments<1>(from, some, channels, i, j, end, totals.data(), sums.data());
    }
  for (std::ptrdiff_t i = 0; i < channels; ++i)
    for (std::ptrdiff_t j = i; j < channels; ++j)
      products[i * channels + j] = products[j * channels + i] =
          static_cast<float>(sums[static_cast<std::size_t>(i * channels + j)] / static_cast<double>(pixels));
  for (std::ptrdiff_t i = 0; i < channels; ++i)
    means[i] = static_cast<float>(totals[static_cast<std::size_t>(i)] / static_cast<double>(pixels));
}

void times(const float* x, std::ptrdiff_t pixels, std::ptrdiff_t channels, const float* matrix,
           const float* row, float* to) {
  const std::ptrdiff_t tiles = (channels + simd::kLanes - 1) / simd::kLanes, width = tiles * simd::kLanes;
  std::vector<float> padded(static_cast<std::size_t>(channels * width)),
      added(static_cast<std::size_t>(width));
  std::copy_n(row, channels, added.begin());
  for (std::ptrdiff_t i = 0; i < channels; ++i)
    std::copy_n(matrix + i * channels, channels, padded.data() + i * width);
  std::ptrdiff_t pixel = 0;
  for (; pixel + kRows < pixels; pixel += kRows)
    // From the last tile back to the first: what it writes beyond a pixel's channels is overwritten.
    for (std::ptrdiff_t j = width - simd::kLanes; j >= 0; j -= simd::kLanes) {
      const float* from = x + pixel * channels;
      simd::Lanes sums[kRows];
      for (simd::Lanes& sum : sums) sum = simd::load(added.data() + j, simd::kLanes);
      for (std::ptrdiff_t i = 0; i < channels; ++i) {
        const simd::Lanes line = simd::load(padded.data() + i * width + j, simd::kLanes);
        for (int r = 0; r < kRows; ++r) sums[r] += from[r * channels + i] * line;
      }
      for (int r = 0; r < kRows; ++r) {
        float* place = to + (pixel + r) * channels + j;
        const std::ptrdiff_t left = to + pixels * channels - place;
        simd::store(sums[r], place, static_cast<int>(std::min<std::ptrdiff_t>(left, simd::kLanes)));
      }
    }
  for (; pixel < pixels; ++pixel)
    for (std::ptrdiff_t j = 0; j < channels; ++j) {
      float sum = row[j];
      for (std::ptrdiff_t i = 0; i < channels; ++i) sum += x[pixel * channels + i] * matrix[i * channels + j];
      to[pixel * channels + j] = sum;
    }
}

void reflect(const float* x, Shape shape, std::ptrdiff_t border, float* to) {
  const std::ptrdiff_t c = shape.channels, pixel = c * static_cast<std::ptrdiff_t>(sizeof(float));
  const std::ptrdiff_t columns = shape.columns + 2 * border;
  for (std::ptrdiff_t row = -border; row < shape.rows + border; ++row) {
    const float* from = x + source(row, shape.rows) * shape.columns * c;
    float* line = to + (row + border) * columns * c;
    std::memcpy(line + border * c, from, static_cast<std::size_t>(shape.columns * pixel));
    for (std::ptrdiff_t k = 1; k <= border; ++k) {
      std::memcpy(line + (border - k) * c, from + source(-k, shape.columns) * c,
                  static_cast<std::size_t>(pixel));
      const std::ptrdiff_t beyond = shape.columns - 1 + k;
      std::memcpy(line + (border + beyond) * c, from + source(beyond, shape.columns) * c,
                  static_cast<std::size_t>(pixel));
    }
  }
}

void reflect_backward(const float* gradient, Shape shape, std::ptrdiff_t border, float* to) {
  const std::ptrdiff_t c = shape.channels, columns = shape.columns + 2 * border;
  for (std::ptrdiff_t row = 0; row < shape.rows; ++row)
    std::memcpy(to + row * shape.columns * c, gradient + ((row + border) * columns + border) * c,
                static_cast<std::size_t>(shape.columns * c) * sizeof(float));
  for (std::ptrdiff_t row = -border; row < shape.rows + border; ++row) {
    const bool copied_row = row >= 0 && row < shape.rows;
    const float* line = gradient + (row + border) * columns * c;
    float* target = to + source(row, shape.rows) * shape.columns * c;
    if (!copied_row) add(line + border * c, shape.columns * c, target);
    for (std::ptrdiff_t k = 1; k <= border; ++k) {
      const std::ptrdiff_t beyond = shape.columns - 1 + k;
      add(line + (border - k) * c, c, target + source(-k, shape.columns) * c);
      add(line + (border + beyond) * c, c, target + source(beyond, shape.columns) * c);
    }
  }
}

void halve(const float* x, Shape shape, float* to) {
  if (shape.channels == 1) return halve_plane(x, shape, to);
  const std::ptrdiff_t c = shape.channels, stride = shape.columns * c;
  for (std::ptrdiff_t row = 0; row < shape.rows / 2; ++row)
    for (std::ptrdiff_t column = 0; column < shape.columns / 2; ++column, to += c) {
      const float* block = x + 2 * row * stride + 2 * column * c;
      for (std::ptrdiff_t k = 0; k < c; ++k)
        to[k] = 0.25f * (block[k] + block[c + k] + block[stride + k] + block[stride + c + k]);
    }
}

void halve_backward(const float* gradient, Shape shape, float* to) {
  const std::ptrdiff_t c = shape.channels, stride = shape.columns * c;
  const std::ptrdiff_t columns = shape.columns / 2;
  for (std::ptrdiff_t row = 0; row < shape.rows; ++row) {
    float* line = to + row * stride;
    if (row / 2 >= shape.rows / 2) {
      std::memset(line, 0, static_cast<std::size_t>(stride) * sizeof(float));
      continue;
    }
    const float* from = gradient + row / 2 * columns * c;
    if (c == 1) {
      double_row(from, shape.columns, line);
      continue;
    }
    for (std::ptrdiff_t column = 0; column < columns; ++column)
      for (std::ptrdiff_t k = 0; k < c; ++k)
        line[2 * column * c + k] = line[(2 * column + 1) * c + k] = 0.25f * from[column * c + k];
    if (shape.columns % 2 == 1)
      std::memset(line + 2 * columns * c, 0, static_cast<std::size_t>(c) * sizeof(float));
  }
}

void rectify_backward(const float* gradient, const float* y, std::ptrdiff_t size, float* to) {
  for (std::ptrdiff_t i = 0; i < size; ++i) to[i] = y[i] > 0 ? gradient[i] : 0;
}

}  // namespace patina::features::PATINA_TARGET
