#include "engine/sampling/step_size_adaptation.h"

#include <algorithm>
#include <cmath>

namespace patina {
namespace {

constexpr double kSearchGamma = 0.05, kRefineGamma = 0.4, kT0 = 10, kKappa = 0.75;

}  // namespace

StepSizeAdaptation::StepSizeAdaptation(double initial_step_size, double target_acceptance)
    : target_(target_acceptance) {
  restart(initial_step_size);
  // Hoffman & Gelman: shrink towards ten times the start, since too small a step costs more than too large a
  // one.
  mu_ += std::log(10.0);
  gamma_ = kSearchGamma;
}

void StepSizeAdaptation::observe(double accept_probability) {
  if (std::isnan(accept_probability)) accept_probability = 0;
  ++count_;
  error_sum_ += target_ - std::clamp(accept_probability, 0.0, 1.0);
  log_step_ = mu_ - std::sqrt(count_) / gamma_ * error_sum_ / (count_ + kT0);
  const double weight = std::pow(count_, -kKappa);
  log_averaged_ = weight * log_step_ + (1 - weight) * log_averaged_;
}

double StepSizeAdaptation::step_size() const { return std::exp(log_step_); }

double StepSizeAdaptation::averaged_step_size() const { return std::exp(log_averaged_); }

void StepSizeAdaptation::restart(double step_size) {
  mu_ = log_step_ = log_averaged_ = std::log(step_size);
  gamma_ = kRefineGamma;
  error_sum_ = 0;
  count_ = 0;
}

}  // namespace patina
