#include "engine/material/cell_map.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <ATen/ops/conv2d.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/pad.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "engine/material/hash.h"
#include "engine/material/quantile_map.h"

namespace patina {
namespace {

// Count, spread and softness of the cells were chosen by the appearance distance to three reference renders
// of leather, 0.07 on average: 55 or 69 bins a side give 0.14, sites wherever chance puts them 0.08, and a
// blur of half the width 0.14.
constexpr int kBins = 62;           // a side; one site somewhere in each
constexpr double kSoftness = 0.15;  // sd of the blur, in bins
constexpr int kReach = 3;           // bins to look around; the nearest site is never more than two away

// Distance to the nearest edge, bent to the distribution of models.md's cells.
constexpr std::array<QuantileKnot, 7> kCellValues{
    {{0, 0.0f}, {0.05, 0.21f}, {0.25, 0.34f}, {0.5, 0.47f}, {0.75, 0.71f}, {0.95, 0.96f}, {1, 1.0f}}};

struct Point {
  float x, y;  ///< in bins
};

float square_distance(Point a, Point b) {
  const float x = a.x - b.x, y = a.y - b.y;
  return x * x + y * y;
}

/// One site somewhere in each bin of a torus.
class Sites {
 public:
  using Near = std::array<Point, (2 * kReach + 1) * (2 * kReach + 1)>;

  Sites(std::uint64_t seed, std::uint64_t stream) : in_bin_(kBins * kBins) {
    for (std::uint64_t i = 0; Point & site : in_bin_) {
      site.x = static_cast<float>(uniform_hash(seed, stream, i++));
      site.y = static_cast<float>(uniform_hash(seed, stream, i++));
    }
  }

  /// The sites of the bins around one, at their places in the plane.
  Near near(int row, int column) const {
    Near sites;
    auto site = sites.begin();
    for (int i = row - kReach; i <= row + kReach; ++i)
      for (int j = column - kReach; j <= column + kReach; ++j) {
        const Point& in_bin =
            in_bin_[static_cast<std::size_t>((i + kBins) % kBins * kBins + (j + kBins) % kBins)];
        *site++ = {static_cast<float>(j) + in_bin.x, static_cast<float>(i) + in_bin.y};
      }
    return sites;
  }

 private:
  std::vector<Point> in_bin_;  ///< offset from the bin's corner
};

/// Distance to the nearest edge of the Voronoi diagram: the least distance to a bisector between the nearest
/// site and another one.
float edge_distance(Point at, const Sites::Near& sites) {
  Point nearest{};
  float least = std::numeric_limits<float>::max();
  for (const Point& site : sites) {
    const float square = square_distance(site, at);
    if (square < least) least = square, nearest = site;
  }
  const float radius = std::sqrt(least);
  float distance = std::numeric_limits<float>::max(), horizon = distance;
  for (const Point& site : sites) {
    const float square = square_distance(site, at);
    // A bisector is no closer than half of what its site is further away than the nearest one.
    if (square >= horizon || square <= least) continue;
    distance = std::min(distance, (square - least) / (2 * std::sqrt(square_distance(site, nearest))));
    horizon = (radius + 2 * distance) * (radius + 2 * distance);
  }
  return distance;
}

/// Gaussian blur of a periodic map, sd in pixels.
at::Tensor blurred(const at::Tensor& map, double sd) {
  const auto reach = static_cast<std::int64_t>(std::ceil(3 * sd));
  const at::Tensor offset = at::arange(-reach, reach + 1, at::kFloat);
  const at::Tensor bell = (offset * offset / (-2 * sd * sd)).exp();
  const at::Tensor weights = bell / bell.sum();
  const at::Tensor wrapped = at::pad(map, {reach, reach, reach, reach}, "circular");
  return at::conv2d(at::conv2d(wrapped, weights.view({1, 1, 1, -1})), weights.view({1, 1, -1, 1}));
}

}  // namespace

at::Tensor make_cell_map(std::uint64_t seed, std::uint64_t stream, int size) {
  const Sites sites(seed, stream);
  const float step = static_cast<float>(kBins) / static_cast<float>(size);
  at::Tensor distances = at::empty({1, 1, size, size}, at::kFloat);
  float* distance = distances.data_ptr<float>();
  for (int row = 0; row < size; ++row) {
    const float y = (static_cast<float>(row) + 0.5f) * step;
    int bin = -1;
    Sites::Near near;
    for (int column = 0; column < size; ++column) {
      const float x = (static_cast<float>(column) + 0.5f) * step;
      if (static_cast<int>(x) != bin) near = sites.near(static_cast<int>(y), bin = static_cast<int>(x));
      *distance++ = edge_distance({x, y}, near);
    }
  }
  at::Tensor map = blurred(distances, kSoftness * size / kBins).contiguous();
  map_to_quantiles({map.data_ptr<float>(), static_cast<std::size_t>(map.numel())}, kCellValues);
  return map;
}

}  // namespace patina
