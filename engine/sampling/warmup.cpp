#include "engine/sampling/warmup.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace patina {

std::vector<WarmupWindow> warmup_schedule(int iterations) {
  if (iterations <= 0) return {};
  if (iterations < 20) return {{0, iterations, false}};
  int first = 75, window = 25, last = 50;
  if (first + window + last > iterations) {  // Stan's shares where its defaults do not fit: 15, 75 and 10 %
    first = iterations * 15 / 100;
    last = iterations / 10;
    window = iterations - first - last;
  }
  std::vector<WarmupWindow> schedule{{0, first, false}};
  const int slow_end = iterations - last;
  for (int begin = first; begin < slow_end; window *= 2) {
    // A window that would leave no room for the next, twice as long, takes the rest.
    const int end = begin + 3 * window > slow_end ? slow_end : begin + window;
    schedule.push_back({begin, end, true});
    begin = end;
  }
  schedule.push_back({slow_end, iterations, false});
  return schedule;
}

ChainWarmup::ChainWarmup(KernelSettings start, double target_acceptance)
    : settings_(std::move(start)),
      step_size_(settings_.step_size, target_acceptance),
      adapts_step_size_(target_acceptance > 0) {}

void ChainWarmup::observe(const ChainState& state, const TransitionInfo& info) {
  positions_.push_back(state.position.continuous);
  if (!adapts_step_size_ || info.move != MoveKind::continuous) return;
  step_size_.observe(info.accept_probability);
  settings_.step_size = step_size_.step_size();
}

WindowResult ChainWarmup::take_window() {
  WindowResult result{Eigen::MatrixXd(settings_.metric->dimension(), positions_.size()),
                      step_size_.averaged_step_size(), settings_.metric};
  for (std::size_t i = 0; i < positions_.size(); ++i) result.positions.col(i) = positions_[i];
  positions_.clear();
  return result;
}

void ChainWarmup::restart(const KernelSettings& pooled) {
  settings_ = pooled;
  step_size_.restart(pooled.step_size);
}

KernelSettings pool(const std::vector<WindowResult>& chains, MetricKind kind, double metric_worth) {
  std::vector<Eigen::MatrixXd> positions;
  std::vector<double> steps;
  double transitions = 0;
  for (const WindowResult& chain : chains) {
    transitions += static_cast<double>(chain.positions.cols());
    positions.push_back(chain.positions);
    steps.push_back(chain.step_size);
  }
  std::ranges::sort(steps);
  const std::size_t n = steps.size();
  const double step = std::sqrt(steps[(n - 1) / 2] * steps[n / 2]);
  Eigen::MatrixXd covariance = pooled_covariance(positions);
  if (metric_worth > 0) {
    const double share = metric_worth / (transitions + metric_worth);
    covariance += share * (chains.front().metric->covariance() - covariance);
  }
  return {step, std::make_shared<const Metric>(restricted(covariance, kind))};
}

Eigen::MatrixXd pooled_covariance(const std::vector<Eigen::MatrixXd>& chains) {
  Eigen::Index dimension = 0, count = 0, degrees_of_freedom = 0;
  for (const Eigen::MatrixXd& chain : chains) dimension = std::max(dimension, chain.rows());
  Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(dimension, dimension);
  for (const Eigen::MatrixXd& chain : chains) {
    if (chain.cols() == 0) continue;
    const Eigen::MatrixXd centred = chain.colwise() - chain.rowwise().mean();
    scatter += centred * centred.transpose();
    count += chain.cols();
    degrees_of_freedom += chain.cols() - 1;
  }
  const Eigen::MatrixXd covariance = scatter / std::max<Eigen::Index>(degrees_of_freedom, 1);
  const double n = static_cast<double>(count);
  return n / (n + 5) * covariance + 1e-3 * 5 / (n + 5) * Eigen::MatrixXd::Identity(dimension, dimension);
}

}  // namespace patina
