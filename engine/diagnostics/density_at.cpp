#include "engine/diagnostics/density_at.h"

#include <cmath>

namespace patina {

DensityEstimate density_at(ChainDraws draws, double point, double width) {
  const bool at_an_end = point < width || point > 1 - width;
  const double end = at_an_end ? std::round(point) : point;
  const Eigen::MatrixXd weights = draws.unaryExpr([&](double x) {
    const double distance = std::abs(x - end);
    const double narrow = distance < width ? 1 : 0, wide = distance < 2 * width ? 1 : 0;
    return at_an_end ? 2 * narrow / width - wide / (2 * width) : narrow / (2 * width);
  });
  return {weights.mean(), mcse_mean(weights)};
}

}  // namespace patina
