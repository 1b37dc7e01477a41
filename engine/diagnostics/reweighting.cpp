#include "engine/diagnostics/reweighting.h"

#include <cmath>
#include <tuple>
#include <utility>

namespace patina {
namespace {

/// Mean of the products, and its standard error.
std::pair<double, double> mean_and_error(const Eigen::ArrayXd& products, double effective) {
  return {products.mean(), standard_deviation(products.matrix()) / std::sqrt(effective)};
}

}  // namespace

Reweighting reweight(const Eigen::Ref<const Eigen::VectorXd>& draws,
                     const Eigen::Ref<const Eigen::VectorXd>& log_ratio, double effective) {
  const Eigen::ArrayXd z = (draws.array() - draws.mean()) / standard_deviation(draws);
  const Eigen::ArrayXd r = log_ratio.array() - log_ratio.mean();
  Reweighting result;
  std::tie(result.mean_shift, result.mean_error) = mean_and_error(z * r, effective);
  std::tie(result.log_spread, result.spread_error) = mean_and_error((z.square() - 1) * r / 2, effective);
  return result;
}

}  // namespace patina
