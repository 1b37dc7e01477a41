#include "engine/sampling/tempering.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "engine/sampling/finite_evaluation.h"

namespace patina {

double log_likelihood(const ChainState& state) {
  return state.evaluation.log_density + 0.5 * state.position.continuous.squaredNorm();
}

TemperedDensity::TemperedDensity(const LogDensity& target, double beta)
    : target_(target), beta_(beta), jagged_(target.jagged()) {
  assert(beta > 0 && beta <= 1);
}

/// Zero along jagged coordinates, as gradients are.
Eigen::VectorXd TemperedDensity::prior_pull(const Position& position) const {
  Eigen::VectorXd pull = -(1 - beta_) * position.continuous;
  for (std::size_t i = 0; i < jagged_.size(); ++i)
    if (jagged_[i]) pull[static_cast<Eigen::Index>(i)] = 0;
  return pull;
}

double TemperedDensity::tempered_value(const Position& position, double of_target) const {
  return beta_ * of_target - (1 - beta_) * 0.5 * position.continuous.squaredNorm();
}

ChainState TemperedDensity::tempered(const ChainState& state) const {
  const Position& x = state.position;
  Evaluation tempered{tempered_value(x, state.evaluation.log_density), {}};
  if (state.evaluation.gradient.size() > 0)
    tempered.gradient = beta_ * state.evaluation.gradient + prior_pull(x);
  return {x, std::move(tempered)};
}

ChainState TemperedDensity::untempered(const ChainState& state) const {
  const Position& x = state.position;
  Evaluation plain{(state.evaluation.log_density + (1 - beta_) * 0.5 * x.continuous.squaredNorm()) / beta_,
                   {}};
  if (state.evaluation.gradient.size() > 0)
    plain.gradient = (state.evaluation.gradient - prior_pull(x)) / beta_;
  return {x, std::move(plain)};
}

Evaluation TemperedDensity::evaluate(const Position& position) const {
  Evaluation of_target = evaluate_finite(target_, position);
  if (!std::isfinite(of_target.log_density)) return of_target;
  return tempered({position, std::move(of_target)}).evaluation;
}

Evaluation TemperedDensity::value(const Position& position) const {
  Evaluation of_target = value_finite(target_, position);
  if (!std::isfinite(of_target.log_density)) return of_target;
  return tempered({position, std::move(of_target)}).evaluation;
}

std::shared_ptr<const Metric> tempered_metric(const std::shared_ptr<const Metric>& of_target, double beta) {
  if (beta == 1) return of_target;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(of_target->covariance());
  const Eigen::ArrayXd variances = axes.eigenvalues().array().max(0);
  const Eigen::VectorXd tempered = variances / (beta + (1 - beta) * variances);
  const Eigen::MatrixXd half = axes.eigenvectors() * tempered.cwiseSqrt().asDiagonal();
  return std::make_shared<const Metric>(half * half.transpose());
}

std::vector<double> first_ladder(int rungs) {
  assert(rungs >= 2);
  std::vector<double> betas;
  // Likelihoods matter from small powers on.
  for (int i = 0; i < rungs; ++i) betas.push_back(std::pow(static_cast<double>(i) / (rungs - 1), 3));
  return betas;
}

std::vector<double> equalised_ladder(const std::vector<double>& betas, const std::vector<double>& rejection) {
  assert(rejection.size() + 1 == betas.size());
  if (betas.size() <= 2) return betas;
  constexpr double kLeast = 1e-4;  // so that the sum rises from rung to rung
  std::vector<double> barrier{0};
  for (const double r : rejection) barrier.push_back(barrier.back() + std::max(r, kLeast));
  std::vector<double> equalised{0};
  std::size_t i = 1;
  for (std::size_t k = 1; k + 1 < betas.size(); ++k) {
    const double wanted = barrier.back() * static_cast<double>(k) / static_cast<double>(rejection.size());
    while (barrier[i] < wanted) ++i;
    const double share = (wanted - barrier[i - 1]) / (barrier[i] - barrier[i - 1]);
    equalised.push_back(std::lerp(betas[i - 1], betas[i], share));
  }
  equalised.push_back(1);
  return equalised;
}

TemperedState tempered_state(std::vector<ChainState> rungs) {
  TemperedState state;
  state.rungs = std::move(rungs);
  state.traveller.resize(state.rungs.size());
  std::iota(state.traveller.begin(), state.traveller.end(), 0);
  state.from_prior.assign(state.rungs.size(), false);
  state.from_prior.front() = true;
  return state;
}

void SwapRecord::add(std::size_t lower_rung, double accept_probability) {
  rejected_[lower_rung] += 1 - accept_probability;
  ++tried_[lower_rung];
}

void SwapRecord::add(const SwapRecord& other) {
  for (std::size_t i = 0; i < tried_.size(); ++i) {
    rejected_[i] += other.rejected_[i];
    tried_[i] += other.tried_[i];
  }
}

std::vector<double> SwapRecord::rejection() const {
  std::vector<double> rejection;
  for (std::size_t i = 0; i < tried_.size(); ++i)
    rejection.push_back(tried_[i] > 0 ? rejected_[i] / static_cast<double>(tried_[i]) : 0);
  return rejection;
}

void SwapRecord::serialise(Archive& archive) {
  archive(rejected_, tried_);
  if (rejected_.size() != tried_.size()) throw ArchiveError("its swaps do not add up");
  for (std::size_t i = 0; i < tried_.size(); ++i)
    if (!(rejected_[i] >= 0 && rejected_[i] <= static_cast<double>(tried_[i])))
      throw ArchiveError("its swaps do not add up");
}

void swap_rungs(const std::vector<double>& betas, TemperedState& state, SwapRecord& record, Rng& rng) {
  const std::size_t last = state.rungs.size() - 1;
  for (auto lower = static_cast<std::size_t>(state.rounds++ % 2); lower < last; lower += 2) {
    ChainState &below = state.rungs[lower], &above = state.rungs[lower + 1];
    const double log_ratio =
        (betas[lower + 1] - betas[lower]) * (log_likelihood(below) - log_likelihood(above));
    const double accept_probability = std::isnan(log_ratio) ? 0 : std::min(1.0, std::exp(log_ratio));
    record.add(lower, accept_probability);
    if (!(rng.uniform() < accept_probability)) continue;
    std::swap(below, above);
    std::swap(state.traveller[lower], state.traveller[lower + 1]);
  }
  state.from_prior[static_cast<std::size_t>(state.traveller.front())] = true;
  char& arrived = state.from_prior[static_cast<std::size_t>(state.traveller.back())];
  state.round_trips += arrived;
  arrived = false;
}

double ideal_round_trip_rate(const std::vector<double>& rejection) {
  double inefficiency = 0;
  for (const double r : rejection) inefficiency += r / (1 - r);
  return 1 / (2 + 2 * inefficiency);
}

}  // namespace patina
