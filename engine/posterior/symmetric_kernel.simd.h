// Read once for each target by each_target.h.
namespace patina::symmetric::PATINA_TARGET {
namespace {

constexpr int kLanes = simd::PATINA_TARGET::kLanes / 2;  // a double takes the room of two floats
typedef double Lanes __attribute__((vector_size(kLanes * sizeof(double))));

PATINA_INLINE Lanes load(const double* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

PATINA_INLINE double sum(const Lanes& lanes) {
  double total = 0;
  for (int k = 0; k < kLanes; ++k) total += lanes[k];
  return total;
}

/// What `count` columns add to the product by their entries below row `from`, and those entries' mirror
/// images in the upper triangle. Several columns at once, so that the product is read and written once.
template <int count>
PATINA_INLINE void add_below(const double* column, const double* x, double* product, std::ptrdiff_t first,
                             std::ptrdiff_t from, std::ptrdiff_t size) {
  Lanes across[count] = {};
  std::ptrdiff_t i = from;
  for (; i + kLanes <= size; i += kLanes) {
    const Lanes here = load(x + i);
    Lanes down = load(product + i);
    for (int c = 0; c < count; ++c) {
      const Lanes entries = load(column + c * size + i);
      down += entries * x[first + c];
      across[c] += entries * here;
    }
    std::memcpy(product + i, &down, sizeof down);
  }
  for (int c = 0; c < count; ++c) {
    double rest = sum(across[c]);
    for (std::ptrdiff_t k = i; k < size; ++k) {
      product[k] += column[c * size + k] * x[first + c];
      rest += column[c * size + k] * x[k];
    }
    product[first + c] += rest;
  }
}

/// The same of the columns' entries among their own rows.
PATINA_INLINE void add_corner(const double* column, const double* x, double* product, std::ptrdiff_t first,
                              std::ptrdiff_t count, std::ptrdiff_t size) {
  for (std::ptrdiff_t c = 0; c < count; ++c) {
    const double* entries = column + c * size + first;
    product[first + c] += entries[c] * x[first + c];
    for (std::ptrdiff_t k = c + 1; k < count; ++k) {
      product[first + k] += entries[k] * x[first + c];
      product[first + c] += entries[k] * x[first + k];
    }
  }
}

}  // namespace

void multiply(const double* matrix, const double* x, double* product, std::ptrdiff_t size) {
  constexpr int kColumns = 4;
  for (std::ptrdiff_t i = 0; i < size; ++i) product[i] = 0;
  std::ptrdiff_t first = 0;
  for (; first + kColumns <= size; first += kColumns) {
    add_corner(matrix + first * size, x, product, first, kColumns, size);
    add_below<kColumns>(matrix + first * size, x, product, first, first + kColumns, size);
  }
  add_corner(matrix + first * size, x, product, first, size - first, size);
}

}  // namespace patina::symmetric::PATINA_TARGET
