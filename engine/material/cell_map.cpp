#include "engine/material/cell_map.h"

#include <ATen/TensorOperators.h>
#include <ATen/core/grad_mode.h>
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

// Count and softness were chosen by the appearance distance to the three reference renders of leather: 3000
// cells, or cells with sharp edges, are further away (0.24 and 0.34 against 0.08).
constexpr int kBins = 69;              // a side; one site a bin on average
constexpr int kSites = kBins * kBins;  // 4761 cells
constexpr int kReach = 3;              // bins to look around; a wider gap has probability below 1e-10
constexpr double kSoftness = 0.15;     // sd of the blur, in bins

// Distance to the nearest edge, bent to the distribution of models.md's cells.
constexpr std::array<QuantileKnot, 7> kCellValues{
    {{0, 0.0f}, {0.05, 0.21f}, {0.25, 0.34f}, {0.5, 0.47f}, {0.75, 0.71f}, {0.95, 0.96f}, {1, 1.0f}}};

struct Offset {
  float x, y;  ///< in bins
  float square() const { return x * x + y * y; }
};

/// Uniform sites on the torus, sorted into bins.
class Sites {
 public:
  Sites(std::uint64_t seed, std::uint64_t stream) : bins_(kBins * kBins) {
    for (std::uint64_t i = 0; i < kSites; ++i) {
      const auto x = static_cast<float>(kBins * uniform_hash(seed, stream, 2 * i));
      const auto y = static_cast<float>(kBins * uniform_hash(seed, stream, 2 * i + 1));
      bins_[bin(static_cast<int>(y), static_cast<int>(x))].push_back({x, y});
    }
  }

  /// Distance from (x, y) to the nearest edge of the Voronoi diagram: the least distance to a bisector
  /// between the nearest site and another one.
  float edge_distance(float x, float y) const {
    Offset nearest{std::numeric_limits<float>::max() / 4, 0};
    for_each_near(x, y, [&](Offset site) {
      if (site.square() < nearest.square()) nearest = site;
    });
    float distance = std::numeric_limits<float>::max();
    for_each_near(x, y, [&](Offset site) {
      const Offset apart{site.x - nearest.x, site.y - nearest.y};
      const float square = apart.square();
      if (square > 1e-12f)
        distance = std::min(distance, (site.square() - nearest.square()) / (2 * std::sqrt(square)));
    });
    return distance;
  }

 private:
  static std::size_t bin(int row, int column) {
    return static_cast<std::size_t>((row + kBins) % kBins * kBins + (column + kBins) % kBins);
  }
  static float wrapped(float d) { return d > kBins / 2.0f ? d - kBins : d < -kBins / 2.0f ? d + kBins : d; }

  template <typename Visit>
  void for_each_near(float x, float y, Visit&& visit) const {
    const int row = static_cast<int>(y), column = static_cast<int>(x);
    for (int i = row - kReach; i <= row + kReach; ++i)
      for (int j = column - kReach; j <= column + kReach; ++j)
        for (const Offset& site : bins_[bin(i, j)]) visit(Offset{wrapped(site.x - x), wrapped(site.y - y)});
  }

  std::vector<std::vector<Offset>> bins_;
};

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
  const at::NoGradGuard no_grad;
  const Sites sites(seed, stream);
  const float step = static_cast<float>(kBins) / static_cast<float>(size);
  at::Tensor distances = at::empty({1, 1, size, size}, at::kFloat);
  float* distance = distances.data_ptr<float>();
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column)
      *distance++ = sites.edge_distance((static_cast<float>(column) + 0.5f) * step,
                                        (static_cast<float>(row) + 0.5f) * step);
  at::Tensor map = blurred(distances, kSoftness * size / kBins).contiguous();
  map_to_quantiles({map.data_ptr<float>(), static_cast<std::size_t>(map.numel())}, kCellValues);
  return map;
}

}  // namespace patina
