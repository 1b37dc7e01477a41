// Read once for each target by each_target.h.
namespace patina::cells::PATINA_TARGET {
namespace simd = patina::simd::PATINA_TARGET;
namespace {

using simd::Bits;
using simd::Lanes;

/// Whether a comparison holds of any.
PATINA_INLINE bool any(const Bits& mask) {
  std::int64_t parts[simd::kLanes / 2], all = 0;
  std::memcpy(parts, &mask, sizeof parts);
  for (const std::int64_t part : parts) all |= part;
  return all != 0;
}

PATINA_INLINE Lanes square_distance(const Lanes& x, const Lanes& y, float other_x, float other_y) {
  const Lanes dx = other_x - x, dy = other_y - y;
  return dx * dx + dy * dy;
}

PATINA_INLINE Lanes edge_distance(const Points& sites, const Lanes& x, const Lanes& y) {
  Lanes least = std::numeric_limits<float>::max() - Lanes{}, nearest_x{}, nearest_y{};
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const Lanes square = square_distance(x, y, sites.x[i], sites.y[i]);
    const Bits nearer = square < least;
    least = nearer ? square : least;
    nearest_x = nearer ? sites.x[i] - Lanes{} : nearest_x;
    nearest_y = nearer ? sites.y[i] - Lanes{} : nearest_y;
  }
  const Lanes radius = simd::sqrt(least);
  Lanes distance = std::numeric_limits<float>::max() - Lanes{}, horizon = distance;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const Lanes square = square_distance(x, y, sites.x[i], sites.y[i]);
    // A bisector is no closer than half of what its site is further away than the nearest one.
    const Bits may_be = (square < horizon) & (square > least);
    if (!any(may_be)) continue;
    const Lanes apart = square_distance(nearest_x, nearest_y, sites.x[i], sites.y[i]);
    const Lanes bisector = (square - least) / (2 * simd::sqrt(apart));
    distance = may_be & (bisector < distance) ? bisector : distance;
    const Lanes reach = radius + 2 * distance;
    horizon = reach * reach;
  }
  return distance;
}

}  // namespace

void edge_distances(const Points& sites, const Points& points, float* to) {
  const auto size = static_cast<std::ptrdiff_t>(points.size());
  for (std::ptrdiff_t i = 0; i < size; i += simd::kLanes) {
    const int count = simd::lanes_from(i, size);
    const Lanes x = simd::load(points.x.data() + i, count), y = simd::load(points.y.data() + i, count);
    simd::store(edge_distance(sites, x, y), to + i, count);
  }
}

}  // namespace patina::cells::PATINA_TARGET
