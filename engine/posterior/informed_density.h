#pragma once

#include <utility>
#include <vector>

#include "engine/sampling/log_density.h"

namespace patina {

/// A density of some coordinates (Posterior::informed()), where the others have their prior N(0, I) and all
/// levels are alike: of places of a texture nothing is known.
class InformedDensity final : public LogDensity {
 public:
  /// @param density   of the informed coordinates, without levels; it outlives this
  /// @param whole     whose dimension and levels this has
  InformedDensity(const LogDensity& density, std::vector<Eigen::Index> informed, const LogDensity& whole)
      : density_(density),
        informed_(std::move(informed)),
        dimension_(whole.dimension()),
        levels_(whole.discrete_levels()) {}

  Eigen::Index dimension() const override { return dimension_; }
  std::vector<int> discrete_levels() const override { return levels_; }

  const std::vector<Eigen::Index>& informed() const { return informed_; }

  Evaluation evaluate(const Position& position) const override {
    const Eigen::VectorXd known = position.continuous(informed_);
    const Evaluation of_known = density_.evaluate({known, {}});
    Evaluation all{of_known.log_density - (position.continuous.squaredNorm() - known.squaredNorm()) / 2,
                   -position.continuous};
    all.gradient(informed_) = of_known.gradient;
    return all;
  }

 private:
  const LogDensity& density_;
  std::vector<Eigen::Index> informed_;
  Eigen::Index dimension_;
  std::vector<int> levels_;
};

}  // namespace patina
