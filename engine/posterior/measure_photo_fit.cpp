#include "engine/posterior/measure_photo_fit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/posterior/least_squares.h"
#include "engine/posterior/quadratic_features.h"

namespace patina {

PhotoFit measure_photo_fit(const Eigen::MatrixXd& offsets, const Eigen::MatrixXd& summaries,
                           const Eigen::VectorXd& photo, const Eigen::VectorXd& offset) {
  const QuadraticFeatures features(offsets.rows(), false);
  const LeastSquares mean(features.design(offsets), summaries);
  const Eigen::VectorXd variances = mean.variances();
  // An entry that never errs in simulations has no unit to measure the photo's error by.
  const Eigen::VectorXd precisions =
      (variances.array() > 1e-20).select(variances.array().max(1e-20).inverse(), 0.0);
  const Eigen::VectorXd distances = (precisions.transpose() * mean.left_out().cwiseAbs2()).transpose();
  const double observed = precisions.dot((photo - mean.coefficients * features.values(offset)).cwiseAbs2());
  std::vector<double> simulated(distances.begin(), distances.end());
  std::ranges::sort(simulated);
  const auto n = static_cast<double>(simulated.size());
  const auto beyond = simulated.end() - std::ranges::lower_bound(simulated, observed);
  const double usual = simulated[static_cast<std::size_t>(std::ceil(0.95 * n)) - 1];
  return {std::sqrt(observed / distances.mean()), (1 + static_cast<double>(beyond)) / (n + 1),
          std::max(1.0, observed / usual)};
}

}  // namespace patina
