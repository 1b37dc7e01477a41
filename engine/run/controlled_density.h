#pragma once

#include "engine/run/run_control.h"
#include "engine/sampling/log_density.h"

namespace patina {

/// A target that obeys the run's controls: every evaluation waits while the run is paused, and throws
/// RunStopped once it is stopped. So any search or kernel pauses and stops within one evaluation.
class ControlledDensity final : public LogDensity {
 public:
  ControlledDensity(const LogDensity& target, RunControl& control) : target_(target), control_(control) {}

  Eigen::Index dimension() const override { return target_.dimension(); }
  std::vector<int> discrete_levels() const override { return target_.discrete_levels(); }
  std::vector<bool> jagged() const override { return target_.jagged(); }
  Evaluation evaluate(const Position& position) const override {
    control_.checkpoint();
    return target_.evaluate(position);
  }
  Evaluation value(const Position& position) const override {
    control_.checkpoint();
    return target_.value(position);
  }

 private:
  const LogDensity& target_;
  RunControl& control_;
};

}  // namespace patina
