#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/sampling/finite_evaluation.h"
#include "engine/sampling/leapfrog.h"
#include "engine/sampling/rng.h"

namespace patina::plain {

// The leapfrog step and the no-U-turn sampler as they are written down: every value is a fresh one, nothing
// is reused. Slow, and what the engine's must equal to the last bit.

inline void leapfrog(const LogDensity& target, const Metric& metric, double step, PhasePoint& point) {
  const Eigen::MatrixXd root = metric.covariance().llt().matrixL();
  const auto kick = [&] {
    const Eigen::VectorXd pull =
        root.triangularView<Eigen::Lower>().transpose() * point.state.evaluation.gradient;
    point.momentum = point.momentum + step / 2 * pull;
  };
  kick();
  const Eigen::VectorXd velocity = root.triangularView<Eigen::Lower>() * point.momentum;
  point.state.position.continuous = point.state.position.continuous + step * velocity;
  point.state.evaluation = evaluate_finite(target, point.state.position);
  kick();
}

struct Tree {
  PhasePoint first, last, draw;
  Eigen::VectorXd sum;
  double log_weight;
};

inline double log_sum_exp(double a, double b) {
  const double top = std::max(a, b);
  return std::isfinite(top) ? top + std::log1p(std::exp(std::min(a, b) - top)) : top;
}

inline bool turns(const Tree& a, const Tree& b) {
  const auto against = [](const PhasePoint& first, const PhasePoint& last, const Eigen::VectorXd& sum) {
    return first.momentum.dot(sum) <= 0 || last.momentum.dot(sum) <= 0;
  };
  const Eigen::VectorXd all = a.sum + b.sum, to_b = a.sum + b.first.momentum,
                        from_a = b.sum + a.last.momentum;
  return against(a.first, b.last, all) || against(a.first, b.first, to_b) || against(a.last, b.last, from_a);
}

inline Tree join(const Tree& a, const Tree& b, bool draw_b) {
  return {a.first, b.last, draw_b ? b.draw : a.draw, a.sum + b.sum, log_sum_exp(a.log_weight, b.log_weight)};
}

/// One transition by Hoffman & Gelman's recursion with Betancourt's multinomial draws.
struct Nuts {
  const LogDensity& target;
  const KernelSettings& settings;
  Rng& rng;
  double start_energy = 0;
  int leapfrogs = 0;
  bool divergent = false;

  std::optional<Tree> build(const PhasePoint& from, bool forward, int depth) {
    if (depth == 0) {
      PhasePoint next = from;
      plain::leapfrog(target, *settings.metric, forward ? settings.step_size : -settings.step_size, next);
      ++leapfrogs;
      divergent = !(energy(next) - start_energy <= kDivergentEnergy);
      if (divergent) return {};
      return Tree{next, next, next, next.momentum, -energy(next)};
    }
    const auto near = build(from, forward, depth - 1);
    if (!near) return {};
    const auto far = build(forward ? near->last : near->first, forward, depth - 1);
    if (!far) return {};
    const Tree& a = forward ? *near : *far;
    const Tree& b = forward ? *far : *near;
    if (turns(a, b)) return {};
    const double share = std::exp(b.log_weight - log_sum_exp(a.log_weight, b.log_weight));
    return join(a, b, rng.uniform() < share);
  }

  int step(ChainState& state, int deepest) {
    const PhasePoint start{state, rng.normals(state.position.continuous.size())};
    start_energy = energy(start);
    Tree all{start, start, start, start.momentum, -start_energy};
    int depth = 0;
    for (bool turned = false; depth < deepest && !turned;) {
      const bool forward = rng.uniform() < 0.5;
      const auto grown = build(forward ? all.last : all.first, forward, depth);
      if (!grown) break;
      ++depth;
      const Tree& a = forward ? all : *grown;
      const Tree& b = forward ? *grown : all;
      turned = turns(a, b);
      const bool draw_grown = rng.uniform() < std::exp(grown->log_weight - all.log_weight);
      all = join(a, b, draw_grown == forward);
    }
    state = all.draw.state;
    return depth;
  }
};

}  // namespace patina::plain
