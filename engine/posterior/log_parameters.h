#pragma once

#include <Eigen/Core>

#include <vector>

#include "engine/posterior/prior_transform.h"

namespace patina {

class Archive;

/// Logarithms of parameters as functions of their sampling coordinates, one by one:
///   x_i = log(theta_i(u_i) - min(low_i, 0) + (high_i - low_i) / 100)
/// Summaries are nearer to polynomials of these than of coordinates: a product, like that of light and
/// albedo, is a sum, and at a bound, where coordinates go on for ever, they come to rest.
class LogParameters {
 public:
  LogParameters() = default;  ///< of none: coordinates stay what they are
  explicit LogParameters(const std::vector<TruncatedNormal>& priors);

  Eigen::VectorXd values(const Eigen::VectorXd& u) const;       ///< x
  Eigen::VectorXd derivatives(const Eigen::VectorXd& u) const;  ///< dx_i / du_i

  /// Whether they are of so many coordinates, or of none.
  bool fits(Eigen::Index dimension) const { return priors_.empty() || std::ssize(priors_) == dimension; }
  void serialise(Archive& archive);

 private:
  double offset(std::size_t i) const;

  std::vector<TruncatedNormal> priors_;
  std::vector<PriorTransform> transforms_;
};

}  // namespace patina
