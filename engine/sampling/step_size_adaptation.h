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

  /// Forgets what it saw and refines a step that is about right: drawn to it, rather than to ten times as
  /// much, and with gamma = 0.4. The windows of a warm-up hold a few tens of observations, after which the
  /// published constants still swing by a factor of e and average to a step that is too small. In 13
  /// dimensions, frozen after 28 observations, HMC that asks for 0.8 is accepted with 0.92 by them, with 0.81
  /// by these.
  void restart(double step_size);

 private:
  double target_, gamma_, mu_, log_step_, log_averaged_, error_sum_ = 0;
  int count_ = 0;
};

}  // namespace patina
