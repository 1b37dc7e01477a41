#include "engine/sampling/natural_spline.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <utility>

namespace patina {
namespace {

/// Harrell's terms for the inner knots, of truncated powers that `power` evaluates.
Eigen::VectorXd terms(const Eigen::VectorXd& knots, const std::function<double(double)>& power) {
  const Eigen::Index last = knots.size() - 1;
  const double span = knots[last] - knots[last - 1], unit = std::pow(knots[last] - knots[0], 2);
  Eigen::VectorXd result(last - 1);
  for (Eigen::Index j = 0; j < last - 1; ++j)
    result[j] = (power(knots[j]) - power(knots[last - 1]) * (knots[last] - knots[j]) / span +
                 power(knots[last]) * (knots[last - 1] - knots[j]) / span) /
                unit;
  return result;
}

}  // namespace

NaturalSplineBasis::NaturalSplineBasis(Eigen::VectorXd knots) : knots_(std::move(knots)) {
  assert(knots_.size() >= 3 && std::ranges::is_sorted(knots_, std::less_equal<>()) &&
         "knots must be ascending");
}

double NaturalSplineBasis::clamped(double x) const {
  return std::clamp(x, knots_[0], knots_[knots_.size() - 1]);
}

Eigen::VectorXd NaturalSplineBasis::values(double x) const {
  Eigen::VectorXd result(size());
  result << 1, x, terms(knots_, [x](double knot) { return std::pow(std::max(x - knot, 0.0), 3); });
  return result;
}

Eigen::VectorXd NaturalSplineBasis::slopes(double x) const {
  Eigen::VectorXd result(size());
  result << 0, 1, terms(knots_, [x](double knot) { return 3 * std::pow(std::max(x - knot, 0.0), 2); });
  return result;
}

}  // namespace patina
