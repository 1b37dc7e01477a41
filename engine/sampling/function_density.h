#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "engine/sampling/log_density.h"

namespace patina {

/// A log density written as a function.
class FunctionDensity final : public LogDensity {
 public:
  using Function = std::function<Evaluation(const Position&)>;

  /// @param levels  of the discrete coordinates
  FunctionDensity(Eigen::Index dimension, Function function, std::vector<int> levels = {})
      : dimension_(dimension), function_(std::move(function)), levels_(std::move(levels)) {}

  Eigen::Index dimension() const override { return dimension_; }
  std::vector<int> discrete_levels() const override { return levels_; }
  Evaluation evaluate(const Position& position) const override { return function_(position); }

 private:
  Eigen::Index dimension_;
  Function function_;
  std::vector<int> levels_;
};

}  // namespace patina
