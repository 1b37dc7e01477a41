#include "engine/sampling/warmup.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace patina {
namespace {

/// In logs.
double median_step(std::vector<double> steps) {
  std::ranges::sort(steps);
  const std::size_t n = steps.size();
  return std::sqrt(steps[(n - 1) / 2] * steps[n / 2]);
}

/// Over the draws of all chains; of no draws, zero.
Eigen::VectorXd mean_of(const std::vector<Eigen::MatrixXd>& chains) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(chains.front().rows());
  Eigen::Index draws = 0;
  for (const Eigen::MatrixXd& chain : chains) {
    sum += chain.rowwise().sum();
    draws += chain.cols();
  }
  return sum / static_cast<double>(std::max<Eigen::Index>(draws, 1));
}

void straighten(std::vector<Eigen::MatrixXd>& chains, const Straightening& map) {
  for (Eigen::MatrixXd& chain : chains)
    for (Eigen::Index i = 0; i < chain.cols(); ++i) chain.col(i) = map.straighten(chain.col(i));
}

/// The covariance that a window was run with, near `centre`, in the coordinates of the next map.
Eigen::MatrixXd previous_covariance(const WindowResult& window, const Straightening* next,
                                    const Eigen::VectorXd& centre) {
  Eigen::MatrixXd covariance = window.metric->covariance();
  if (window.straightening)
    covariance = window.straightening->covariance_in_x(centre[window.straightening->lead()], covariance);
  if (next) covariance = next->covariance_in_y(centre[next->lead()], covariance);
  return covariance;
}

}  // namespace

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
    // A window that would leave no room for the next, twice as long, takes the rest, or half of it if there
    // is room for two: what is learnt last is learnt where the window before has led.
    const int rest = slow_end - begin;
    const int end = rest >= 3 * window ? begin + window : rest >= 2 * window ? begin + rest / 2 : slow_end;
    schedule.push_back({begin, end, true});
    begin = end;
  }
  schedule.push_back({slow_end, iterations, false});
  return schedule;
}

bool chains_meet(const WarmupWindow& window, int iterations) {
  return window.adapts_metric || window.end == iterations;
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
                      step_size_.averaged_step_size(), settings_.metric, settings_.straightening};
  for (std::size_t i = 0; i < positions_.size(); ++i) result.positions.col(i) = positions_[i];
  positions_.clear();
  return result;
}

void ChainWarmup::restart(const KernelSettings& pooled) {
  settings_ = pooled;
  step_size_.restart(pooled.step_size);
}

bool ChainWarmup::has_dimension(Eigen::Index dimension) const {
  return std::ranges::all_of(positions_, [&](const auto& position) { return position.size() == dimension; });
}

KernelSettings pool(const std::vector<WindowResult>& chains, MetricKind kind, double metric_worth,
                    const std::vector<bool>& jagged) {
  std::vector<Eigen::MatrixXd> positions;
  std::vector<double> steps;
  double transitions = 0;
  for (const WindowResult& chain : chains) {
    transitions += static_cast<double>(chain.positions.cols());
    positions.push_back(chain.positions);
    steps.push_back(chain.step_size);
  }
  KernelSettings pooled{median_step(std::move(steps)), nullptr, nullptr};
  if (kind == MetricKind::curved) pooled.straightening = fit_straightening(positions, jagged);
  const Eigen::VectorXd centre = mean_of(positions);
  if (pooled.straightening) straighten(positions, *pooled.straightening);
  Eigen::MatrixXd covariance = pooled_covariance(positions);
  if (metric_worth > 0) {
    const double share = metric_worth / (transitions + metric_worth);
    covariance +=
        share * (previous_covariance(chains.front(), pooled.straightening.get(), centre) - covariance);
  }
  pooled.metric = std::make_shared<const Metric>(restricted(covariance, kind));
  return pooled;
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
