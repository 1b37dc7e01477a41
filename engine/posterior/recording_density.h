#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "engine/posterior/posterior.h"

namespace patina {

/// Evaluations of a posterior with their residuals, in order.
struct Evaluated {
  std::vector<Eigen::VectorXd> places;  ///< informed coordinates
  std::vector<Eigen::VectorXf> residuals;
};

/// A posterior that keeps where it was asked and what the residuals are there; without gradients. For one
/// thread.
class RecordingDensity final : public LogDensity {
 public:
  /// All that is given outlives this.
  /// @param observed   the photo's summary in the units of Posterior::predicted()
  /// @param evaluated  called after each evaluation; may be empty, may throw
  RecordingDensity(const Posterior& posterior, const std::vector<Eigen::Index>& informed,
                   const Eigen::VectorXd& observed, const std::function<void()>& evaluated, Evaluated& record)
      : posterior_(posterior),
        informed_(informed),
        observed_(observed),
        evaluated_(evaluated),
        record_(record) {}

  Eigen::Index dimension() const override { return posterior_.dimension(); }
  std::vector<int> discrete_levels() const override { return posterior_.discrete_levels(); }
  std::vector<bool> jagged() const override { return posterior_.jagged(); }

  Evaluation evaluate(const Position& position) const override {
    if (!position.continuous.allFinite()) return {-std::numeric_limits<double>::infinity(), {}};
    const Eigen::VectorXd residual = posterior_.predicted(position) - observed_;
    if (evaluated_) evaluated_();
    const double squares = residual.squaredNorm();
    if (!std::isfinite(squares)) return {-std::numeric_limits<double>::infinity(), {}};
    record_.places.emplace_back(position.continuous(informed_));
    record_.residuals.emplace_back(residual.cast<float>());
    return {-(position.continuous.squaredNorm() + squares) / 2, {}};
  }

 private:
  const Posterior& posterior_;
  const std::vector<Eigen::Index>& informed_;
  const Eigen::VectorXd& observed_;
  const std::function<void()>& evaluated_;
  Evaluated& record_;
};

}  // namespace patina
