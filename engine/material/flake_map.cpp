#include "engine/material/flake_map.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/empty.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "engine/material/hash.h"

namespace patina {
namespace {

// Lengths in bins. A bin is so small that it holds one site at most, the least distance being sqrt 2. Their
// number was chosen by the appearance distance to three reference renders of flakes: 0.06 on average; 270 and
// 300 bins give 0.08.
constexpr int kFlakeBins = 285;  // a side
constexpr float kSquareDistance = 2;
constexpr int kThrowsPerBin = 12;
constexpr int kFlakeReach = 3;  // bins to look around: no gap between sites is as wide

struct Site {
  float x, y;              ///< in bins
  float slope_x, slope_y;  ///< of its flake
};

/// The unit Beckmann distribution: radius sqrt(-ln u), uniform angle; no steeper than 1, as in the paper's
/// map.
void draw_slope(Site& site, double for_radius, double for_angle) {
  const double radius = std::min(1.0, std::sqrt(-std::log(1 - for_radius)));
  const double angle = 2 * std::numbers::pi * for_angle;
  site.slope_x = static_cast<float>(radius * std::cos(angle));
  site.slope_y = static_cast<float>(radius * std::sin(angle));
}

/// A blue-noise point set on a torus by dart throwing (Cook 1986): sites wherever chance puts them, but none
/// within sqrt 2 bins of an earlier one.
class FlakeSites {
 public:
  FlakeSites(std::uint64_t seed, std::uint64_t stream) : bins_(kFlakeBins * kFlakeBins) {
    constexpr std::uint64_t kThrows = std::uint64_t{kThrowsPerBin} * kFlakeBins * kFlakeBins;
    for (std::uint64_t i = 0; i < kThrows; ++i) {
      const auto random = [&](std::uint64_t k) { return uniform_hash(seed, stream, 4 * i + k); };
      Site site{static_cast<float>(kFlakeBins * random(0)), static_cast<float>(kFlakeBins * random(1)), 0, 0};
      if (nearest(site.x, site.y, 2).square_distance < kSquareDistance) continue;
      draw_slope(site, random(2), random(3));
      bin(static_cast<int>(site.y), static_cast<int>(site.x)) = site;
    }
  }

  struct Found {
    const Site* site = nullptr;
    float square_distance = std::numeric_limits<float>::max();
  };

  /// The nearest site among the bins within `reach` of (x, y).
  Found nearest(float x, float y, int reach) const {
    Found found;
    const int row = static_cast<int>(y), column = static_cast<int>(x);
    for (int i = row - reach; i <= row + reach; ++i)
      for (int j = column - reach; j <= column + reach; ++j) {
        const std::optional<Site>& site = bins_[index(i, j)];
        if (!site) continue;
        const float dx = apart(site->x - x), dy = apart(site->y - y), square = dx * dx + dy * dy;
        if (square < found.square_distance) found = {&*site, square};
      }
    return found;
  }

 private:
  static int wrapped(int i) { return i < 0 ? i + kFlakeBins : i >= kFlakeBins ? i - kFlakeBins : i; }
  static float apart(float difference) {
    const float distance = std::abs(difference);
    return std::min(distance, static_cast<float>(kFlakeBins) - distance);
  }
  static std::size_t index(int row, int column) {
    return static_cast<std::size_t>(wrapped(row) * kFlakeBins + wrapped(column));
  }
  std::optional<Site>& bin(int row, int column) { return bins_[index(row, column)]; }

  std::vector<std::optional<Site>> bins_;
};

}  // namespace

MipMap make_flake_map(std::uint64_t seed, std::uint64_t stream, int size) {
  const FlakeSites sites(seed, stream);
  const float step = static_cast<float>(kFlakeBins) / static_cast<float>(size);
  at::Tensor map = at::empty({1, 3, size, size}, at::kFloat);
  auto texel = map.accessor<float, 4>()[0];
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const auto centre = [step](int i) { return (static_cast<float>(i) + 0.5f) * step; };
      const Site& site = *sites.nearest(centre(column), centre(row), kFlakeReach).site;
      texel[0][row][column] = site.slope_x;
      texel[1][row][column] = site.slope_y;
      texel[2][row][column] = site.slope_x * site.slope_x + site.slope_y * site.slope_y;
    }
  MipMap mips = make_mip_map(map);
  for (at::Tensor& level : mips.levels) level.select(1, 2) -= level.narrow(1, 0, 2).square().sum(1);
  return mips;
}

}  // namespace patina
