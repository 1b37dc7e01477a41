#pragma once

#include <atomic>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/chart/problem.h"
#include "engine/sampling/kernels.h"
#include "tests/sampling/targets.h"

namespace patina {

/// A target whose every moment is known: a level with probabilities 0.5, 0.3, 0.2, and three coordinates that
/// are normal given it, the first shifted by the level. In the settings' "biased" summary the second
/// coordinate's mean is off by kBias of its sds; of any resolution that a setting asks for all means are off
/// by half of that.
class GaussianProblem final : public ChartProblem {
 public:
  static constexpr double kBias = 0.4;

  explicit GaussianProblem(std::vector<double> levels = {0.5, 0.3, 0.2}) : levels_(std::move(levels)) {}

  std::string description() const override { return "a correlated Gaussian, of <known> moments & levels"; }
  std::vector<std::string> names() const override {
    std::vector<std::string> names{"a", "b", "c"};
    if (!levels_.empty()) names.push_back("level");
    return names;
  }

  std::vector<std::unique_ptr<LogDensity>> targets(const ChartSetting& setting) const override {
    Eigen::VectorXd mean = this->mean();
    if (setting.resolution > 0) mean += 0.5 * kBias * covariance().diagonal().cwiseSqrt();
    if (setting.summary == "biased") mean[1] += kBias * std::sqrt(covariance()(1, 1));
    const GaussianTarget gaussian(mean, covariance());
    const auto evaluate = [=, this](Position position) {
      ++evaluations_;
      double log_prior = 0;
      if (!levels_.empty()) {
        position.continuous[0] -= shift(position.discrete[0]);
        log_prior = std::log(levels_[static_cast<std::size_t>(position.discrete[0])]);
      }
      Evaluation evaluation = gaussian.evaluate(position);
      evaluation.log_density += log_prior;
      return evaluation;
    };
    std::vector<int> counts;
    if (!levels_.empty()) counts.push_back(static_cast<int>(levels_.size()));
    std::vector<std::unique_ptr<LogDensity>> targets;
    targets.push_back(std::make_unique<FunctionDensity>(3, evaluate, counts));
    return targets;
  }

  Eigen::VectorXd values(const Position& position) const override { return position.continuous; }
  std::unique_ptr<Kernel> kernel(const ChartSetting& setting, const LogDensity& target) const override;

  double probability(std::size_t level) const { return levels_[level]; }
  double true_mean(Eigen::Index i) const { return mean()[i] + (i == 0 ? shift_moment(1) : 0); }
  double true_sd(Eigen::Index i) const {
    const double of_shift = i == 0 ? shift_moment(2) - std::pow(shift_moment(1), 2) : 0;
    return std::sqrt(covariance()(i, i) + of_shift);
  }
  long evaluations() const { return evaluations_; }  ///< by all targets so far

 private:
  static Eigen::VectorXd mean() { return Eigen::Vector3d(0.3, -0.5, 0.8); }
  static Eigen::MatrixXd covariance() {
    Eigen::Matrix3d matrix;
    matrix << 0.25, 0.10, 0.02, 0.10, 0.16, -0.04, 0.02, -0.04, 0.36;
    return matrix;
  }
  static double shift(int level) { return 0.4 * level; }
  double shift_moment(int power) const {
    double sum = 0;
    for (std::size_t i = 0; i < levels_.size(); ++i)
      sum += levels_[i] * std::pow(shift(static_cast<int>(i)), power);
    return sum;
  }

  std::vector<double> levels_;
  mutable std::atomic<long> evaluations_{0};
};

/// Accepts by the square root of the ratio: its draws have twice the variance. Its steps are short, so that
/// what it is worth is no excuse.
class LenientKernel final : public Kernel {
 public:
  TransitionInfo step(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                      Rng& rng) const override {
    const FunctionDensity flat(
        target.dimension(),
        [&](const Position& position) {
          Evaluation evaluation = target.evaluate(position);
          evaluation.log_density /= 2;
          evaluation.gradient /= 2;
          return evaluation;
        },
        target.discrete_levels());
    state.evaluation.log_density /= 2;
    const TransitionInfo info = kernel_->step(flat, settings, state, rng);
    state.evaluation.log_density *= 2;
    return info;
  }
  double target_acceptance() const override { return 0.6; }

 private:
  std::unique_ptr<Kernel> kernel_ = make_random_walk();
};

inline std::unique_ptr<Kernel> GaussianProblem::kernel(const ChartSetting& setting,
                                                       const LogDensity& target) const {
  if (setting.kernel == "lenient") return std::make_unique<LenientKernel>();
  return ChartProblem::kernel(setting, target);
}

/// The default but for fewer warm-up iterations.
inline ChartSetting quick_setting(const std::string& name = kDefaultSetting) {
  ChartSetting setting = default_setting();
  setting.name = name;
  setting.warmup = 200;
  return setting;
}

}  // namespace patina
