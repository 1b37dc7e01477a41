#pragma once

#include <Eigen/Core>

#include <vector>

#include "engine/material/parameter.h"

namespace patina {

/// The map u = Phi^-1(F(t)) between a parameter t with a truncated-normal prior (cdf F) and a coordinate u in
/// which that prior is N(0, 1). It has no Jacobian to remember and no stiff bounds: t in (low, high) is all
/// of R. Coordinates are cut at |u| = 8, where less than 1e-15 of the prior is left.
class PriorTransform {
 public:
  /// @throws UserError unless low < high, sd > 0, all finite, and the interval holds some of the normal's
  /// mass
  explicit PriorTransform(const TruncatedNormal& prior);

  double value(double u) const;       ///< t, always within [low, high]
  double derivative(double u) const;  ///< dt/du; 0 beyond the cut
  double coordinate(double t) const;  ///< u; t outside [low, high] is taken as the nearer bound

 private:
  double standard_score(double u) const;

  TruncatedNormal prior_;
  double below_;   ///< mass of N(mean, sd^2) below low
  double inside_;  ///< between low and high
  double above_;
};

/// Values of a table's continuous parameters, from as many coordinates.
std::vector<double> values_at(const ParameterTable& table, const Eigen::VectorXd& coordinates);

/// Standard deviation of the truncated normal itself, as the prior sd of a posterior's sd / prior sd.
double truncated_sd(const TruncatedNormal& prior);

}  // namespace patina
