#pragma once

#include "engine/sampling/log_density.h"

namespace patina::posteriordb {

/// A target of posteriordb, and the way from its unconstrained coordinates to the parameters it reports.
class Model : public LogDensity {
 public:
  virtual Eigen::VectorXd parameters(const Eigen::VectorXd& unconstrained) const = 0;
};

}  // namespace patina::posteriordb
