#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "engine/sampling/kernels.h"
#include "engine/sampling/leapfrog.h"

namespace patina {
namespace {

/// A stretch of trajectory, in order of time, and the point drawn from it.
struct Span {
  Eigen::VectorXd first, last, sum;  ///< momenta: at both ends, and added up over all points
  double log_weight;                 ///< log of the sum of exp(-energy)
  ChainState draw;
  double draw_energy;
};

Span span_of(const PhasePoint& point) {
  const double h = energy(point);
  return {point.momentum, point.momentum, point.momentum, -h, point.state, h};
}

double log_sum_exp(double a, double b) {
  const double top = std::max(a, b);
  return std::isfinite(top) ? top + std::log1p(std::exp(std::min(a, b) - top)) : top;
}

Span join(Span earlier, Span later, bool draw_later) {
  Span all{std::move(earlier.first),
           std::move(later.last),
           earlier.sum + later.sum,
           log_sum_exp(earlier.log_weight, later.log_weight),
           {},
           0};
  Span& drawn = draw_later ? later : earlier;
  all.draw = std::move(drawn.draw);
  all.draw_energy = drawn.draw_energy;
  return all;
}

bool points_along(const Eigen::VectorXd& first, const Eigen::VectorXd& last, const Eigen::VectorXd& sum) {
  return first.dot(sum) > 0 && last.dot(sum) > 0;
}

/// The generalised criterion (Betancourt 2017, appendix A.4.2) over both, and over each with the nearest
/// point of the other, which sees the turns that fall in between (Stan, since 2.21).
bool makes_a_turn(const Span& earlier, const Span& later) {
  return !points_along(earlier.first, later.last, earlier.sum + later.sum) ||
         !points_along(earlier.first, later.first, earlier.sum + later.first) ||
         !points_along(earlier.last, later.last, later.sum + earlier.last);
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
    Span all = span_of(ends_[0]);
    bool turned = false;
    while (info.tree_depth < deepest && !turned) {
      const bool forward = rng_.uniform() < 0.5;
      std::optional<Span> grown = extend(forward, info.tree_depth);
      if (!grown) break;
      ++info.tree_depth;
      turned = forward ? makes_a_turn(all, *grown) : makes_a_turn(*grown, all);
      // Biased towards the new half, which is valid at the top alone (Betancourt 2017, appendix A.3.2).
      const bool draw_new = rng_.uniform() < std::exp(grown->log_weight - all.log_weight);
      info.accepted |= draw_new;
      all = forward ? join(std::move(all), std::move(*grown), draw_new)
                    : join(std::move(*grown), std::move(all), !draw_new);
    }
    state = std::move(all.draw);
    info.accept_probability = accept_sum_ / std::max(leapfrogs_, 1);
    info.divergent = divergent_;
    info.evaluations = leapfrogs_;
    info.energy = all.draw_energy;
    return info;
  }

 private:
  /// The next 2^depth points at one end; nothing if they diverge, or turn in one of their own subtrees: then
  /// the reverse trajectory would never have come here.
  std::optional<Span> extend(bool forward, int depth) {
    if (depth == 0) return extend_by_one(forward);
    std::optional<Span> near = extend(forward, depth - 1);
    if (!near) return {};
    std::optional<Span> far = extend(forward, depth - 1);
    if (!far) return {};
    Span& earlier = forward ? *near : *far;
    Span& later = forward ? *far : *near;
    if (makes_a_turn(earlier, later)) return {};
    const double share = std::exp(later.log_weight - log_sum_exp(earlier.log_weight, later.log_weight));
    const bool draw_later = rng_.uniform() < share;
    return join(std::move(earlier), std::move(later), draw_later);
  }

  std::optional<Span> extend_by_one(bool forward) {
    PhasePoint& end = ends_[forward];
    leapfrog(target_, *settings_.metric, forward ? settings_.step_size : -settings_.step_size, end);
    ++leapfrogs_;
    const double rise = energy(end) - start_energy_;
    const bool finite = std::isfinite(energy(end));
    if (finite) accept_sum_ += std::min(1.0, std::exp(-rise));
    divergent_ = !finite || rise > kDivergentEnergy;
    if (divergent_) return {};
    return span_of(end);
  }

  const LogDensity& target_;
  const KernelSettings& settings_;
  Rng& rng_;
  std::array<PhasePoint, 2> ends_;  ///< back in time, and forward
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
    return Trajectory(target, settings, state, rng).run(deepest_, state);
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
