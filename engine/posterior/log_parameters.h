#pragma once

#include <Eigen/Core>

#include <vector>

#include "engine/posterior/prior_transform.h"

namespace patina {

class Archive;

/// Logarithms of parameters as functions of their sampling coordinates, one by one:
///   x_i = log(theta_i(u_i) - min(low_i, 0) + scale_i)
/// Summaries are nearer to polynomials of these than of coordinates: a product, like that of light and
/// albedo, is a sum, and at a bound, where coordinates go on for ever, they come to rest. Values far below
/// their scale are alike.
class LogParameters {
 public:
  LogParameters() = default;  ///< of none: coordinates stay what they are
  /// @param scales  positive, in the parameters' units, one each
  LogParameters(const std::vector<TruncatedNormal>& priors, const Eigen::VectorXd& scales);

  /// Those about a place: scales are a tenth of where a standard deviation above it leads. A parameter that
  /// is known to be 0.05 of 0 to 2 is then a logarithm, one that may as well be 0 is nearly itself. (With a
  /// thousandth of the prior's width instead, chains of leather_6 were caught at a rough_var of 0; with a
  /// hundredth, where its ridge of power times height ends.)
  /// @param place  sampling coordinates   @param sds  of these, about
  static LogParameters about(const std::vector<TruncatedNormal>& priors, const Eigen::VectorXd& place,
                             const Eigen::VectorXd& sds);

  Eigen::VectorXd values(const Eigen::VectorXd& u) const;       ///< x
  Eigen::VectorXd derivatives(const Eigen::VectorXd& u) const;  ///< dx_i / du_i

  /// Whether they are of so many coordinates, or of none.
  bool fits(Eigen::Index dimension) const;
  void serialise(Archive& archive);

 private:
  double offset(std::size_t i) const;  ///< what is added to theta_i

  std::vector<TruncatedNormal> priors_;
  std::vector<PriorTransform> transforms_;
  Eigen::VectorXd scales_;
};

}  // namespace patina
