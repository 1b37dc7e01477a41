#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "engine/sampling/kernels.h"
#include "engine/sampling/leapfrog.h"
#include "engine/sampling/metropolis.h"

namespace patina {
namespace {

/// A stretch of trajectory, in order of time, and the point drawn from it.
struct Span {
  Eigen::VectorXd first, last, sum;  ///< momenta: at both ends, and added up over all points
  double log_weight = 0;             ///< log of the sum of exp(-energy)
  ChainState draw;
  double draw_energy = 0;

  /// Into the vectors that are there: a trajectory is made of hundreds, and allocating would be its cost.
  void be_point(const PhasePoint& point, double energy) {
    first = last = sum = point.momentum;
    log_weight = -energy;
    draw.position.continuous = point.state.position.continuous;
    draw.position.discrete = point.state.position.discrete;
    draw.evaluation.log_density = point.state.evaluation.log_density;
    draw.evaluation.gradient = point.state.evaluation.gradient;
    draw_energy = energy;
  }
};

double log_sum_exp(double a, double b) {
  const double top = std::max(a, b);
  return std::isfinite(top) ? top + std::log1p(std::exp(std::min(a, b) - top)) : top;
}

bool points_along(const Eigen::VectorXd& first, const Eigen::VectorXd& last, const Eigen::VectorXd& sum) {
  return first.dot(sum) > 0 && last.dot(sum) > 0;
}

/// One transition's trajectory, which grows at both ends.
class Trajectory {
 public:
  Trajectory(const LogDensity& target, const KernelSettings& settings, const ChainState& state, Rng& rng)
      : target_(target), settings_(settings), rng_(rng) {
    ends_[0] = {state, rng.normals(state.position.continuous.size())};
    ends_[1] = ends_[0];
    start_energy_ = energy(ends_[0]);
  }

  /// Doubles until it turns, diverges or has doubled `deepest` times; then moves `state` to the point drawn.
  TransitionInfo run(int deepest, ChainState& state) {
    TransitionInfo info;
    info.tree_depth = 0;
    spans_.resize(static_cast<std::size_t>(deepest));
    Span all;
    all.be_point(ends_[0], start_energy_);
    bool turned = false;
    while (info.tree_depth < deepest && !turned) {
      const bool forward = rng_.uniform() < 0.5;
      Span& grown = spans_[static_cast<std::size_t>(info.tree_depth)];
      if (!extend(forward, info.tree_depth, grown)) break;
      ++info.tree_depth;
      turned = makes_a_turn(forward ? all : grown, forward ? grown : all);
      // Biased towards the new half, which is valid at the top alone (Betancourt 2017, appendix A.3.2).
      const bool draw_new = rng_.uniform() < std::exp(grown.log_weight - all.log_weight);
      info.accepted |= draw_new;
      join(all, grown, forward, draw_new);
    }
    state = std::move(all.draw);
    info.accept_probability = accept_sum_ / std::max(leapfrogs_, 1);
    info.divergent = divergent_;
    info.evaluations = leapfrogs_;
    info.energy = all.draw_energy;
    return info;
  }

 private:
  /// Makes `grown` the next 2^depth points at one end. False if they diverge, or turn in one of their own
  /// subtrees: then the reverse trajectory would never have come here.
  bool extend(bool forward, int depth, Span& grown) {
    if (depth == 0) return extend_by_one(forward, grown);
    Span& far = spans_[static_cast<std::size_t>(depth) - 1];
    if (!extend(forward, depth - 1, grown) || !extend(forward, depth - 1, far)) return false;
    const Span& earlier = forward ? grown : far;
    const Span& later = forward ? far : grown;
    if (makes_a_turn(earlier, later)) return false;
    const double share = std::exp(later.log_weight - log_sum_exp(earlier.log_weight, later.log_weight));
    const bool draw_later = rng_.uniform() < share;
    join(grown, far, forward, draw_later == forward);
    return true;
  }

  bool extend_by_one(bool forward, Span& grown) {
    PhasePoint& end = ends_[forward];
    leapfrog(target_, *settings_.metric, forward ? settings_.step_size : -settings_.step_size, end);
    ++leapfrogs_;
    const double here = energy(end), rise = here - start_energy_;
    const bool finite = std::isfinite(here);
    if (finite) accept_sum_ += std::min(1.0, std::exp(-rise));
    divergent_ = !finite || rise > kDivergentEnergy;
    if (!divergent_) grown.be_point(end, here);
    return !divergent_;
  }

  /// The generalised criterion (Betancourt 2017, appendix A.4.2) over both, and over each with the nearest
  /// point of the other, which sees the turns that fall in between (Stan, since 2.21). Leaves sum_ the sum
  /// over both.
  bool makes_a_turn(const Span& earlier, const Span& later) {
    sum_ = earlier.sum + later.sum;
    if (!points_along(earlier.first, later.last, sum_)) return true;
    partial_ = earlier.sum + later.first;
    if (!points_along(earlier.first, later.first, partial_)) return true;
    partial_ = later.sum + earlier.last;
    return !points_along(earlier.last, later.last, partial_);
  }

  /// Adds to `all`, after makes_a_turn() of the two, the span that follows it, or comes before it; what is
  /// left of that is for reuse.
  void join(Span& all, Span& more, bool forward, bool draw_more) {
    all.sum.swap(sum_);
    (forward ? all.last : all.first).swap(forward ? more.last : more.first);
    all.log_weight = log_sum_exp(all.log_weight, more.log_weight);
    if (!draw_more) return;
    std::swap(all.draw, more.draw);
    all.draw_energy = more.draw_energy;
  }

  const LogDensity& target_;
  const KernelSettings& settings_;
  Rng& rng_;
  std::array<PhasePoint, 2> ends_;  ///< back in time, and forward
  std::vector<Span> spans_;  ///< [k]: of 2^k points, the far half of a span or the newest of the trajectory
  Eigen::VectorXd sum_, partial_;
  double start_energy_;
  double accept_sum_ = 0;
  int leapfrogs_ = 0;
  bool divergent_ = false;
};

class Nuts final : public Kernel {
 public:
  explicit Nuts(int deepest) : deepest_(deepest) {}

  TransitionInfo step(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                      Rng& rng) const override {
    assert(settings.metric && settings.metric->dimension() == state.position.continuous.size());
    return with_gradient(target, state,
                         [&] { return Trajectory(target, settings, state, rng).run(deepest_, state); });
  }

  double target_acceptance() const override { return 0.8; }  // Stan's

 private:
  int deepest_;
};

}  // namespace

std::unique_ptr<Kernel> make_nuts(int deepest) {
  if (deepest < 1) throw std::invalid_argument("a tree must have a depth");
  return std::make_unique<Nuts>(deepest);
}

}  // namespace patina
