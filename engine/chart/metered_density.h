#pragma once

#include <atomic>
#include <chrono>

#include "engine/sampling/log_density.h"

namespace patina {

/// Thrown inside a trial's threads once its time is over. Never leaves the trial.
struct OutOfTime {};

/// Counts evaluations and ends them when time is over; shared by the densities of one trial.
class Meter {
 public:
  using Clock = std::chrono::steady_clock;
  explicit Meter(Clock::time_point deadline = Clock::time_point::max()) : deadline_(deadline) {}

  /// @throws OutOfTime
  void count(bool with_gradient) {
    if (deadline_ != Clock::time_point::max() && Clock::now() >= deadline_) throw OutOfTime();
    (with_gradient ? gradients_ : values_).fetch_add(1, std::memory_order_relaxed);
  }
  long evaluations() const { return gradients_ + values_; }  ///< all
  long values() const { return values_; }                    ///< those without gradient

 private:
  Clock::time_point deadline_;
  std::atomic<long> gradients_{0}, values_{0};
};

/// A target whose evaluations are counted.
class MeteredDensity final : public LogDensity {
 public:
  MeteredDensity(const LogDensity& target, Meter& meter) : target_(target), meter_(meter) {}

  Eigen::Index dimension() const override { return target_.dimension(); }
  std::vector<int> discrete_levels() const override { return target_.discrete_levels(); }
  std::vector<bool> jagged() const override { return target_.jagged(); }
  Evaluation evaluate(const Position& position) const override {
    meter_.count(/*with_gradient=*/true);
    return target_.evaluate(position);
  }
  Evaluation value(const Position& position) const override {
    meter_.count(/*with_gradient=*/false);
    return target_.value(position);
  }

 private:
  const LogDensity& target_;
  Meter& meter_;
};

}  // namespace patina
