#pragma once

namespace patina {

/// Dual averaging of the log step size towards a mean acceptance probability (Nesterov 2009; Hoffman & Gelman
/// 2014, section 3.2, with their constants gamma = 0.05, t0 = 10, kappa = 0.75).
class StepSizeAdaptation {
 public:
  StepSizeAdaptation(double initial_step_size, double target_acceptance);

  void observe(double accept_probability);  ///< NaN counts as 0
  double step_size() const;                 ///< to explore with
  double averaged_step_size() const;        ///< to freeze
  void restart(double step_size);

 private:
  double target_, mu_, log_step_, log_averaged_, error_sum_ = 0;
  int count_ = 0;
};

}  // namespace patina
