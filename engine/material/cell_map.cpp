#include "engine/material/cell_map.h"

#include <ATen/ops/empty.h>

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "engine/material/hash.h"
#include "engine/material/quantile_map.h"

namespace patina {
namespace {

constexpr int kBins = 55;              // a side; one site a bin on average
constexpr int kSites = kBins * kBins;  // 3025 cells
constexpr int kReach = 3;              // bins to look around; a wider gap has probability below 1e-10

// Distance to the nearest edge, bent to the distribution of models.md's cells.
constexpr std::array<QuantileKnot, 7> kCellValues{
    {{0, 0.0f}, {0.05, 0.21f}, {0.25, 0.34f}, {0.5, 0.47f}, {0.75, 0.71f}, {0.95, 0.96f}, {1, 1.0f}}};

struct Site {
  float x, y;  ///< in bins
};

/// Uniform sites on the torus, sorted into bins.
class Sites {
 public:
  Sites(std::uint64_t seed, std::uint64_t stream) : bins_(kBins * kBins) {
    for (std::uint64_t i = 0; i < kSites; ++i) {
      const Site site{static_cast<float>(kBins * uniform_hash(seed, stream, 2 * i)),
                      static_cast<float>(kBins * uniform_hash(seed, stream, 2 * i + 1))};
      bins_[static_cast<std::size_t>(bin(static_cast<int>(site.y), static_cast<int>(site.x)))].push_back(
          site);
    }
  }

  /// Distance to the second nearest site minus that to the nearest: 0 on the edges of the Voronoi diagram.
  float edge_distance(float x, float y) const {
    float first = std::numeric_limits<float>::max(), second = first;
    const int row = static_cast<int>(y), column = static_cast<int>(x);
    for (int i = row - kReach; i <= row + kReach; ++i)
      for (int j = column - kReach; j <= column + kReach; ++j)
        for (const Site& site : bins_[static_cast<std::size_t>(bin(i, j))]) {
          const float dx = wrapped(site.x - x), dy = wrapped(site.y - y);
          const float square = dx * dx + dy * dy;
          if (square < first) {
            second = first;
            first = square;
          } else if (square < second) {
            second = square;
          }
        }
    return std::sqrt(second) - std::sqrt(first);
  }

 private:
  static int bin(int row, int column) { return (row + kBins) % kBins * kBins + (column + kBins) % kBins; }
  static float wrapped(float d) { return d > kBins / 2.0f ? d - kBins : d < -kBins / 2.0f ? d + kBins : d; }

  std::vector<std::vector<Site>> bins_;
};

}  // namespace

at::Tensor make_cell_map(std::uint64_t seed, std::uint64_t stream, int size) {
  const Sites sites(seed, stream);
  at::Tensor map = at::empty({1, 1, size, size}, at::kFloat);
  const std::span<float> values(map.data_ptr<float>(), static_cast<std::size_t>(map.numel()));
  const float step = static_cast<float>(kBins) / static_cast<float>(size);
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column)
      values[static_cast<std::size_t>(row) * static_cast<std::size_t>(size) +
             static_cast<std::size_t>(column)] =
          sites.edge_distance((static_cast<float>(column) + 0.5f) * step,
                              (static_cast<float>(row) + 0.5f) * step);
  map_to_quantiles(values, kCellValues);
  return map;
}

}  // namespace patina
