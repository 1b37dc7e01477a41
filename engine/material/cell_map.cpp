#include "engine/material/cell_map.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <ATen/ops/conv2d.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/pad.h>
#include <ATen/ops/softplus.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/material/hash.h"

namespace patina {
namespace {

// Count, spread, and width of the edges were chosen by the appearance distance to three reference renders of
// leather, 0.06 on average over two seeds: with 60 bins it is 0.08, with sites that spread over one or two
// bins 0.07, with edges 0.18 wide 0.12.
constexpr int kBins = 62;        // a side; each has a site
constexpr double kSpread = 1.5;  // bins a side that a site may be anywhere in, about the middle of its own
constexpr double kEdge = 0.15;   // width of an edge, in bins
constexpr int kReach = 3;        // bins to look around: as far as an edge shows

// From the profile to values whose quantiles are those of models.md's cells.
constexpr double kSlope = 1.58, kBottom = -0.503;
// Where many edges meet values would fall to 0, of which C^power makes pits that no leather has; matches of
// photographs were full of them. With 0.25 the distance to the renders is 0.08. Rounded, for a rim would
// shine.
constexpr double kFloor = 0.15, kRounding = 0.015;

struct Point {
  float x, y;  ///< in bins
};

float square_distance(Point a, Point b) {
  const float x = a.x - b.x, y = a.y - b.y;
  return x * x + y * y;
}

/// A site about each bin of a torus.
class Sites {
 public:
  using Near = std::array<Point, (2 * kReach + 1) * (2 * kReach + 1)>;

  Sites(std::uint64_t seed, std::uint64_t stream) : of_bin_(kBins * kBins) {
    const auto offset = [&](std::uint64_t place) {
      return static_cast<float>(0.5 + kSpread * (uniform_hash(seed, stream, place) - 0.5));
    };
    for (std::uint64_t i = 0; Point & site : of_bin_) {
      site.x = offset(i++);
      site.y = offset(i++);
    }
  }

  /// The sites of the bins around one, at their places in the plane.
  Near near(int row, int column) const {
    Near sites;
    auto site = sites.begin();
    for (int i = row - kReach; i <= row + kReach; ++i)
      for (int j = column - kReach; j <= column + kReach; ++j) {
        const Point& offset =
            of_bin_[static_cast<std::size_t>((i + kBins) % kBins * kBins + (j + kBins) % kBins)];
        *site++ = {static_cast<float>(j) + offset.x, static_cast<float>(i) + offset.y};
      }
    return sites;
  }

 private:
  std::vector<Point> of_bin_;  ///< offset from the bin's corner
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
  // As steep beside an edge as its width lets it be, round at its bottom and flat inside.
  const at::Tensor profile = blurred((distances / kEdge).tanh(), kEdge * size / kBins);
  const at::Tensor above = at::softplus(profile * kSlope + (kBottom - kFloor), 1 / kRounding);
  return (above + kFloor).clamp_max(1).contiguous();
}

}  // namespace patina
