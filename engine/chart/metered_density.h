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
  void count() {
    if (deadline_ != Clock::time_point::max() && Clock::now() >= deadline_) throw OutOfTime();
    evaluations_.fetch_add(1, std::memory_order_relaxed);
  }
  long evaluations() const { return evaluations_.load(std::memory_order_relaxed); }

 private:
  Clock::time_point deadline_;
  std::atomic<long> evaluations_{0};
};

/// A target whose evaluations are counted.
class MeteredDensity final : public LogDensity {
 public:
  MeteredDensity(const LogDensity& target, Meter& meter) : target_(target), meter_(meter) {}

  Eigen::Index dimension() const override { return target_.dimension(); }
  std::vector<int> discrete_levels() const override { return target_.discrete_levels(); }
  std::vector<bool> jagged() const override { return target_.jagged(); }
  Evaluation evaluate(const Position& position) const override {
    meter_.count();
    return target_.evaluate(position);
  }

 private:
  const LogDensity& target_;
  Meter& meter_;
};

}  // namespace patina
