#pragma once

#include <cstddef>
#include <vector>

/// Distances to the edges of a Voronoi diagram, many points at a time.
namespace patina::cells {

/// In the plane, coordinate by coordinate.
struct Points {
  std::vector<float> x, y;
  std::size_t size() const { return x.size(); }
  void add(float at_x, float at_y) {
    x.push_back(at_x);
    y.push_back(at_y);
  }
};

/// To the nearest edge: the least distance to a bisector between the nearest site and another one.
/// @param sites  all that may be near, at least two   @param to  [points]
void edge_distances(const Points& sites, const Points& points, float* to);

}  // namespace patina::cells
