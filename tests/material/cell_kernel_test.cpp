#include "engine/material/cell_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/material/hash.h"

namespace patina {
namespace {

cells::Points scattered(std::uint64_t stream, std::size_t count) {
  cells::Points points;
  for (std::uint64_t i = 0; i < count; ++i)
    points.add(static_cast<float>(7 * uniform_hash(1, stream, 2 * i)),
               static_cast<float>(7 * uniform_hash(1, stream, 2 * i + 1)));
  return points;
}

/// From a point to the line of equal distances to two sites, by its normal.
double to_bisector(double x, double y, const cells::Points& sites, std::size_t a, std::size_t b) {
  const double nx = double{sites.x[b]} - sites.x[a], ny = double{sites.y[b]} - sites.y[a];
  const double middle_x = (double{sites.x[a]} + sites.x[b]) / 2,
               middle_y = (double{sites.y[a]} + sites.y[b]) / 2;
  return std::abs((x - middle_x) * nx + (y - middle_y) * ny) / std::hypot(nx, ny);
}

double edge_distance(double x, double y, const cells::Points& sites) {
  const auto apart = [&](std::size_t i) { return std::hypot(sites.x[i] - x, sites.y[i] - y); };
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < sites.size(); ++i)
    if (apart(i) < apart(nearest)) nearest = i;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < sites.size(); ++i)
    if (i != nearest) least = std::min(least, to_bisector(x, y, sites, nearest, i));
  return least;
}

TEST(CellKernel, DistanceIsToTheNearestBisectorOfTheNearestSiteAndAnother) {
  const cells::Points sites = scattered(1, 49);
  for (const std::size_t count : {1, 3, 4, 7, 8, 15, 16, 17, 300}) {
    const cells::Points points = scattered(2 + count, count);
    std::vector<float> distances(count + 1, -1);
    cells::edge_distances(sites, points, distances.data());
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_NEAR(distances[i], edge_distance(points.x[i], points.y[i], sites), 1e-5) << i << " of " << count;
    EXPECT_EQ(distances.back(), -1) << "behind the last";
  }
}

}  // namespace
}  // namespace patina
