#pragma once

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "engine/sampling/chain_state.h"
#include "engine/sampling/rng.h"
#include "tests/sampling/targets.h"

namespace patina {

/// A target with exact draws that nothing about is Gaussian or symmetric. With a, b independent logs of
/// Exp(1), t of Beta(2, 1) on a box, k of {0, 1, 2} with probabilities 0.5, 0.3, 0.2:
///   x = (a + k/2, b - x0/2, logit t)    (a shear and a shift, so the Jacobian is that of the logit alone)
class SkewedTarget final : public LogDensity {
 public:
  static constexpr std::array<double, 3> kLevelWeights{0.5, 0.3, 0.2};

  /// @param with_jacobian  false: the wrong density that forgets the logit's Jacobian, as a negative control
  explicit SkewedTarget(bool with_jacobian = true) : with_jacobian_(with_jacobian) {}

  Eigen::Index dimension() const override { return 3; }
  std::vector<int> discrete_levels() const override { return {3}; }

  Evaluation evaluate(const Position& position) const override {
    const Independent parts = independent(position);
    // d/da (a - e^a) = 1 - e^a for the log of an exponential variable; t has density 2 t, dt/dx = t (1 - t).
    const double slope_a = 1 - std::exp(parts.a), slope_b = 1 - std::exp(parts.b);
    Evaluation evaluation;
    evaluation.log_density = parts.a - std::exp(parts.a) + parts.b - std::exp(parts.b) + std::log(parts.t) +
                             std::log(kLevelWeights[position.discrete[0]]);
    evaluation.gradient = Eigen::Vector3d(slope_a + slope_b / 2, slope_b, 1 - parts.t);
    if (with_jacobian_) {
      evaluation.log_density += std::log(parts.t) + std::log1p(-parts.t);
      evaluation.gradient[2] += 1 - 2 * parts.t;
    }
    return evaluation;
  }

  struct Independent {
    double a, b, t;
  };

  static Independent independent(const Position& position) {
    const Eigen::VectorXd& x = position.continuous;
    return {x[0] - 0.5 * position.discrete[0], x[1] + 0.5 * x[0], 1 / (1 + std::exp(-x[2]))};
  }

  static Position exact_draw(Rng& rng) {
    const double pick = rng.uniform();
    const int level = pick < 0.5 ? 0 : pick < 0.8 ? 1 : 2;
    const double a = std::log(-std::log(rng.uniform())), b = std::log(-std::log(rng.uniform()));
    const double t = std::sqrt(rng.uniform());
    const double x0 = a + 0.5 * level;
    return {Eigen::Vector3d(x0, b - 0.5 * x0, std::log(t) - std::log1p(-t)),
            Eigen::VectorXi::Constant(1, level)};
  }

 private:
  bool with_jacobian_;
};

}  // namespace patina
