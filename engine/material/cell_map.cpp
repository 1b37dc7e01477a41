#include "engine/material/cell_map.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/arange.h>
#include <ATen/ops/conv2d.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/pad.h>
#include <ATen/ops/softplus.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/material/cell_kernel.h"
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

/// A site about each bin of a torus.
class Sites {
 public:
  Sites(std::uint64_t seed, std::uint64_t stream) : of_bin_(kBins * kBins) {
    const auto offset = [&](std::uint64_t place) {
      return static_cast<float>(0.5 + kSpread * (uniform_hash(seed, stream, place) - 0.5));
    };
    for (std::uint64_t i = 0; Offset & site : of_bin_) {
      site.x = offset(i++);
      site.y = offset(i++);
    }
  }

  /// The sites of the bins around one, at their places in the plane, in bins.
  cells::Points near(int row, int column) const {
    cells::Points sites;
    for (int i = row - kReach; i <= row + kReach; ++i)
      for (int j = column - kReach; j <= column + kReach; ++j) {
        const Offset& offset =
            of_bin_[static_cast<std::size_t>((i + kBins) % kBins * kBins + (j + kBins) % kBins)];
        sites.add(static_cast<float>(j) + offset.x, static_cast<float>(i) + offset.y);
      }
    return sites;
  }

 private:
  struct Offset {
    float x, y;  ///< from the bin's corner, in bins
  };
  std::vector<Offset> of_bin_;
};

/// Of a map's pixels, where along a row they lie and which of them lie in each bin.
class Ruler {
 public:
  explicit Ruler(int size)
      : step_(static_cast<float>(kBins) / static_cast<float>(size)), first_(kBins + 1, size) {
    for (int pixel = size - 1; pixel >= 0; --pixel) first_[static_cast<std::size_t>(place(pixel))] = pixel;
    for (auto bin = first_.size() - 1; bin > 0; --bin)
      first_[bin - 1] = std::min(first_[bin - 1], first_[bin]);
  }

  float place(int pixel) const { return (static_cast<float>(pixel) + 0.5f) * step_; }  ///< in bins
  int begin(int bin) const { return first_[static_cast<std::size_t>(bin)]; }
  int end(int bin) const { return first_[static_cast<std::size_t>(bin) + 1]; }

 private:
  float step_;
  std::vector<int> first_;
};

/// Of each pixel to the nearest edge of the Voronoi diagram of the sites, in bins. @return [1, 1, size, size]
at::Tensor edge_distances(const Sites& sites, int size) {
  const Ruler ruler(size);
  at::Tensor map = at::empty({1, 1, size, size}, at::kFloat);
  float* to = map.data_ptr<float>();
  std::vector<float> distances;
  for (int row = 0; row < kBins; ++row)
    for (int column = 0; column < kBins; ++column) {
      cells::Points pixels;
      for (int i = ruler.begin(row); i < ruler.end(row); ++i)
        for (int j = ruler.begin(column); j < ruler.end(column); ++j)
          pixels.add(ruler.place(j), ruler.place(i));
      distances.resize(pixels.size());
      cells::edge_distances(sites.near(row, column), pixels, distances.data());
      auto distance = distances.begin();
      const std::ptrdiff_t width = ruler.end(column) - ruler.begin(column);
      for (int i = ruler.begin(row); i < ruler.end(row); ++i, distance += width)
        std::copy_n(distance, width, to + std::ptrdiff_t{i} * size + ruler.begin(column));
    }
  return map;
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
  const at::Tensor distances = edge_distances(Sites(seed, stream), size);
  // As steep beside an edge as its width lets it be, round at its bottom and flat inside.
  const at::Tensor profile = blurred((distances / kEdge).tanh(), kEdge * size / kBins);
  const at::Tensor above = at::softplus(profile * kSlope + (kBottom - kFloor), 1 / kRounding);
  return (above + kFloor).clamp_max(1).contiguous();
}

}  // namespace patina
