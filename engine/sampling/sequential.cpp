#include "engine/sampling/sequential.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "engine/sampling/parallel_for.h"
#include "engine/sampling/prior_draw.h"
#include "engine/sampling/tempering.h"

namespace patina {
namespace {

constexpr double kMinusInfinity = -std::numeric_limits<double>::infinity();

/// Stan's shrinkage of the columns' covariance.
Eigen::MatrixXd shrunk_covariance(Eigen::MatrixXd places) {
  const auto n = static_cast<double>(places.cols());
  places.colwise() -= places.rowwise().mean().eval();
  return n / (n + 5) / (n - 1) * places * places.transpose() +
         1e-3 * 5 / (n + 5) * Eigen::MatrixXd::Identity(places.rows(), places.rows());
}

/// Of columns before and after, each direction of the metric weighing the same.
double correlation_of(Eigen::MatrixXd before, Eigen::MatrixXd after, const Metric& metric) {
  before.colwise() -= before.rowwise().mean().eval();
  after.colwise() -= after.rowwise().mean().eval();
  const Eigen::LLT<Eigen::MatrixXd> factor(metric.covariance());
  factor.matrixL().solveInPlace(before);
  factor.matrixL().solveInPlace(after);
  return before.cwiseProduct(after).sum() / std::sqrt(before.squaredNorm() * after.squaredNorm());
}

struct Particle {
  ChainState state;  ///< evaluated by the target itself
  Rng rng;
  double accepted = 0;  ///< continuous moves' acceptance probabilities on this rung
  int continuous = 0;
};

class Population {
 public:
  Population(const LogDensity& target, const Kernel& kernel, const SequentialSettings& settings)
      : target_(target),
        kernel_(kernel),
        settings_(settings),
        log_evidences_(static_cast<std::size_t>(settings.islands), 0.0),
        step_size_(kernel.target_acceptance() > 0 ? 1 : 0.5) {
    const int count = settings.islands * settings.particles;
    particles_.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
      particles_.push_back({{}, Rng(settings.seed, static_cast<std::uint64_t>(i) + 1)});
    for_all([&](Particle& particle) { particle.state = prior_state(target_, particle.rng); });
    if (std::ranges::none_of(particles_,
                             [](const Particle& p) { return std::isfinite(log_likelihood(p.state)); }))
      throw std::invalid_argument("no draw of N(0, I) has a density");
  }

  SequentialResult run() {
    Rng rng(settings_.seed, 0);
    SequentialResult result;
    result.betas = {0};
    while (result.betas.back() < 1) {
      const double beta = next_beta(result.betas.back());
      for (std::size_t island = 0; island < log_evidences_.size(); ++island)
        weight_and_resample(island, beta - result.betas.back(), rng);
      result.betas.push_back(beta);
      result.worst_correlation = std::max(result.worst_correlation, move(beta));
      if (settings_.reached) settings_.reached(beta);
    }
    result.evidence = evidence();
    result.transitions = transitions_;
    const double best = *std::ranges::max_element(log_evidences_);
    for (std::size_t i = 0; i < particles_.size(); ++i) {
      result.particles.push_back(std::move(particles_[i].state));
      result.log_weights.push_back(log_evidences_[i / island_size()] - best);
    }
    return result;
  }

 private:
  std::size_t island_size() const { return static_cast<std::size_t>(settings_.particles); }

  void for_all(const std::function<void(Particle&)>& work) {
    parallel_for(
        particles_.size(), settings_.threads, [&](std::size_t i) { work(particles_[i]); },
        settings_.enter_thread);
  }

  /// The share of the particles that as many equally weighted ones would be worth (Kong, Liu, Wong 1994).
  double effective_share(double power) const {
    std::vector<double> once, twice;
    for (const Particle& particle : particles_) {
      const double log_weight = power * log_likelihood(particle.state);
      if (!std::isfinite(log_weight)) continue;
      once.push_back(log_weight);
      twice.push_back(2 * log_weight);
    }
    return std::exp(2 * log_sum_exp(once) - log_sum_exp(twice)) / static_cast<double>(particles_.size());
  }

  /// By bisection: the share falls with the power.
  double next_beta(double beta) const {
    constexpr int kHalvings = 40;
    constexpr double kSmallestStep = 1e-6;
    double low = 0, high = 1 - beta;
    if (effective_share(high) >= settings_.effective_share) return 1;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = (low + high) / 2;
      (effective_share(middle) >= settings_.effective_share ? low : high) = middle;
    }
    return beta + std::max(low, kSmallestStep);
  }

  /// Systematic resampling, each island for itself.
  void weight_and_resample(std::size_t island, double power, Rng& rng) {
    const std::size_t n = island_size(), first = island * n;
    std::vector<double> log_weights(n, kMinusInfinity);
    for (std::size_t i = 0; i < n; ++i)
      if (const double l = log_likelihood(particles_[first + i].state); std::isfinite(l))
        log_weights[i] = power * l;
    const double total = log_sum_exp(log_weights), offset = rng.uniform();
    log_evidences_[island] += total - std::log(static_cast<double>(n));
    if (!std::isfinite(total)) return;
    std::vector<ChainState> drawn;
    double passed = 0;
    for (std::size_t i = 0; i < n; ++i) {
      passed += std::exp(log_weights[i] - total) * static_cast<double>(n);
      while (drawn.size() < n && static_cast<double>(drawn.size()) + offset < passed)
        drawn.push_back(particles_[first + i].state);
    }
    while (drawn.size() < n) drawn.push_back(drawn.back());  // what rounding left out
    for (std::size_t i = 0; i < n; ++i) particles_[first + i].state = std::move(drawn[i]);
  }

  /// A particle a column.
  Eigen::MatrixXd places() const {
    Eigen::MatrixXd places(target_.dimension(), std::ssize(particles_));
    for (std::size_t i = 0; i < particles_.size(); ++i)
      places.col(static_cast<Eigen::Index>(i)) = particles_[i].state.position.continuous;
    return places;
  }

  /// Moves all particles until they have forgotten their places. @return the correlation that is left
  double move(double beta) {
    const TemperedDensity density(target_, beta);
    const Eigen::MatrixXd before = places();
    const auto metric = std::make_shared<const Metric>(shrunk_covariance(before));
    double correlation = 1;
    for (int turn = 0; turn < settings_.most_moves && correlation > settings_.correlation; ++turn) {
      const KernelSettings now{step_size_, metric};
      for_all([&](Particle& particle) { move(density, now, particle); });
      transitions_ += std::ssize(particles_);
      adapt_step_size();
      correlation = correlation_of(before, places(), *metric);
    }
    return correlation;
  }

  void move(const TemperedDensity& density, const KernelSettings& now, Particle& particle) const {
    particle.accepted = particle.continuous = 0;
    if (!std::isfinite(particle.state.evaluation.log_density)) return;
    ChainState state = density.tempered(particle.state);
    const TransitionInfo info = kernel_.step(density, now, state, particle.rng);
    if (info.move == MoveKind::continuous) {
      particle.accepted = std::isfinite(info.accept_probability) ? info.accept_probability : 0;
      particle.continuous = 1;
    }
    if (info.accepted) particle.state = density.untempered(state);
  }

  /// The larger the step, the fewer the acceptances, and by about as many logs.
  void adapt_step_size() {
    double accepted = 0;
    int continuous = 0;
    for (const Particle& particle : particles_) {
      accepted += particle.accepted;
      continuous += particle.continuous;
    }
    if (continuous > 0 && kernel_.target_acceptance() > 0)
      step_size_ *= std::exp(accepted / continuous - kernel_.target_acceptance());
  }

  /// The islands' mean: each is unbiased, their logarithms are not.
  LogEvidence evidence() const {
    const auto n = static_cast<double>(log_evidences_.size());
    const double mean = log_sum_exp(log_evidences_) - std::log(n);
    double squares = 0;
    for (const double log_evidence : log_evidences_)
      squares += std::pow(std::exp(log_evidence - mean) - 1, 2);
    return {mean, std::sqrt(squares / (n - 1) / n)};
  }

  const LogDensity& target_;
  const Kernel& kernel_;
  const SequentialSettings& settings_;
  std::vector<Particle> particles_;  ///< island after island
  std::vector<double> log_evidences_;
  double step_size_;
  long transitions_ = 0;
};

}  // namespace

SequentialResult sample_sequentially(const LogDensity& target, const Kernel& kernel,
                                     const SequentialSettings& settings) {
  return Population(target, kernel, settings).run();
}

}  // namespace patina
