#include "gui/plot/density_levels.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>

namespace patina {
namespace {

/// Half of a Gaussian's weights, from its middle outwards; all of them sum to 1.
std::vector<float> half_kernel(double sd) {
  const int reach = static_cast<int>(std::ceil(3.5 * sd));
  std::vector<double> weights;
  for (int i = 0; i <= reach; ++i) weights.push_back(sd > 0 ? std::exp(-0.5 * i * i / (sd * sd)) : 1.0);
  double sum = weights[0];
  for (int i = 1; i <= reach; ++i) sum += 2 * weights[static_cast<std::size_t>(i)];
  std::vector<float> kernel;
  for (const double weight : weights) kernel.push_back(static_cast<float>(weight / sum));
  return kernel;
}

/// Smooths along a row, and returns the picture turned: rows become columns.
Image smoothed_and_turned(const Image& image, const std::vector<float>& kernel) {
  Image result(image.height, image.width, 1);
  const int reach = static_cast<int>(kernel.size()) - 1;
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const float value = image.at(row, column, 0);
      if (value == 0) continue;
      const int first = std::max(0, column - reach), last = std::min(image.width - 1, column + reach);
      for (int to = first; to <= last; ++to)
        result.at(to, row, 0) += value * kernel[static_cast<std::size_t>(std::abs(to - column))];
    }
  }
  return result;
}

}  // namespace

Image smoothed_counts(const Image& counts, double sd_across, double sd_down) {
  assert(counts.channels == 1);
  return smoothed_and_turned(smoothed_and_turned(counts, half_kernel(sd_across)), half_kernel(sd_down));
}

std::vector<double> highest_density_levels(const Image& density, std::span<const double> shares) {
  assert(density.channels == 1);
  std::vector<float> cells = density.pixels;
  std::sort(cells.begin(), cells.end(), std::greater<>());
  double total = 0;
  for (const float cell : cells) total += cell;
  std::vector<double> levels;
  for (const double share : shares) {
    double held = 0;
    double level = 0;
    for (const float cell : cells) {
      held += cell;
      level = cell;
      if (held >= share * total) break;
    }
    levels.push_back(level);
  }
  return levels;
}

}  // namespace patina
