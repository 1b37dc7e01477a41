#include "engine/sampling/evolution.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

#include "engine/sampling/finite_evaluation.h"
#include "engine/sampling/parallel_for.h"

namespace patina {
namespace {

/// The normal distribution that generations are drawn from. Names are the tutorial's.
class Strategy {
 public:
  Strategy(const Eigen::VectorXd& mean, const EvolutionSettings& settings)
      : n_(static_cast<double>(mean.size())),
        mean_(mean),
        sigma_(settings.spread),
        weights_(settings.population / 2),
        path_c_(Eigen::VectorXd::Zero(mean.size())),
        path_sigma_(path_c_) {
    const int population = settings.population;
    shape_by(settings.shape.size() > 0 ? settings.shape
                                       : Eigen::MatrixXd::Identity(mean.size(), mean.size()));
    for (Eigen::Index i = 0; i < weights_.size(); ++i)
      weights_[i] = std::log(0.5 * (population + 1)) - std::log(static_cast<double>(i + 1));
    weights_ /= weights_.sum();
    effective_ = 1 / weights_.squaredNorm();
    c_c_ = (4 + effective_ / n_) / (n_ + 4 + 2 * effective_ / n_);
    c_sigma_ = (effective_ + 2) / (n_ + effective_ + 5);
    c_1_ = 2 / ((n_ + 1.3) * (n_ + 1.3) + effective_);
    c_mu_ = std::min(1 - c_1_, 2 * (effective_ - 2 + 1 / effective_) / ((n_ + 2) * (n_ + 2) + effective_));
    damping_ = 1 + 2 * std::max(0.0, std::sqrt((effective_ - 1) / (n_ + 1)) - 1) + c_sigma_;
    usual_norm_ = std::sqrt(n_) * (1 - 1 / (4 * n_) + 1 / (21 * n_ * n_));
  }

  /// A step from the mean, in units of sigma.
  Eigen::VectorXd step(Rng& rng) const { return axes_ * lengths_.cwiseProduct(rng.normals(mean_.size())); }

  Eigen::VectorXd place(const Eigen::VectorXd& step) const { return mean_ + sigma_ * step; }

  double width() const { return sigma_ * lengths_.maxCoeff(); }

  /// @param best  the better half of a generation's steps, best first, a column each
  void follow(const Eigen::MatrixXd& best) {
    const Eigen::VectorXd step = best * weights_;
    mean_ += sigma_ * step;
    path_sigma_ =
        (1 - c_sigma_) * path_sigma_ + std::sqrt(c_sigma_ * (2 - c_sigma_) * effective_) *
                                           (axes_ * (axes_.transpose() * step).cwiseQuotient(lengths_));
    const double usual = usual_norm_ * std::sqrt(1 - std::pow(1 - c_sigma_, 2 * ++generation_));
    // A path that grows too fast is not learnt from until sigma has caught up.
    const bool steady = path_sigma_.norm() < (1.4 + 2 / (n_ + 1)) * usual;
    path_c_ = (1 - c_c_) * path_c_ + (steady ? std::sqrt(c_c_ * (2 - c_c_) * effective_) : 0) * step;
    const double lost = steady ? 0 : c_1_ * c_c_ * (2 - c_c_);
    sigma_ *= std::exp(c_sigma_ / damping_ * (path_sigma_.norm() / usual_norm_ - 1));
    shape_by((1 - c_1_ - c_mu_ + lost) * covariance_ + c_1_ * path_c_ * path_c_.transpose() +
             c_mu_ * best * weights_.asDiagonal() * best.transpose());
  }

 private:
  void shape_by(const Eigen::MatrixXd& covariance) {
    covariance_ = (covariance + covariance.transpose()) / 2;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance_);
    axes_ = solver.eigenvectors();
    lengths_ = solver.eigenvalues().cwiseMax(1e-20).cwiseSqrt();
  }

  double n_;
  Eigen::VectorXd mean_;
  double sigma_;
  Eigen::VectorXd weights_, path_c_, path_sigma_;
  Eigen::MatrixXd covariance_, axes_;
  Eigen::VectorXd lengths_;  ///< square roots of the covariance's eigenvalues
  double effective_, c_c_, c_sigma_, c_1_, c_mu_, damping_, usual_norm_;
  int generation_ = 0;
};

/// Indices of the better half, best first.
std::vector<Eigen::Index> better_half(const std::vector<double>& values) {
  std::vector<Eigen::Index> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater(),
                           [&](Eigen::Index i) { return values[static_cast<std::size_t>(i)]; });
  order.resize(order.size() / 2);
  return order;
}

}  // namespace

OptimizerResult evolve(const LogDensity& target, const Position& start, Rng& rng,
                       const EvolutionSettings& settings) {
  OptimizerResult best{start, value_finite(target, start), 1, {}};
  Strategy strategy(start.continuous, settings);
  const auto count = static_cast<std::size_t>(settings.population);
  for (int generation = 0; generation < settings.generations && strategy.width() > settings.narrow;
       ++generation) {
    if (settings.stop_requested && settings.stop_requested()) break;
    Eigen::MatrixXd steps(start.continuous.size(), settings.population);
    for (auto step : steps.colwise()) step = strategy.step(rng);
    std::vector<double> values(count);
    const auto at = [&](Eigen::Index i) { return Position{strategy.place(steps.col(i)), start.discrete}; };
    parallel_for(
        count, settings.threads,
        [&](std::size_t i) {
          values[i] = value_finite(target, at(static_cast<Eigen::Index>(i))).log_density;
        },
        settings.enter_thread);
    const std::vector<Eigen::Index> order = better_half(values);
    const double top = values[static_cast<std::size_t>(order.front())];
    if (top > best.evaluation.log_density) {
      best.position = at(order.front());
      best.evaluation = {top, {}};
    }
    best.evaluations += settings.population;
    strategy.follow(steps(Eigen::all, order));
    if (settings.evolved) settings.evolved(best);
  }
  return best;
}

}  // namespace patina
