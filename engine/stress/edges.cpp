#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "engine/stress/density.h"
#include "engine/stress/quadrature.h"
#include "engine/stress/scenarios.h"

namespace patina {
namespace {

using OneDimension = std::function<double(double)>;

/// Independent coordinates of one log density, with the gradient that automatic differentiation would give.
KnownPosterior repeated(Eigen::Index dimension, const OneDimension& log_density, const OneDimension& slope) {
  KnownPosterior posterior = in_coordinates(dimension, [=](const Position& p) {
    Evaluation e{0, Eigen::VectorXd(dimension)};
    for (Eigen::Index i = 0; i < dimension; ++i) {
      e.log_density += log_density(p.continuous[i]);
      e.gradient[i] = slope(p.continuous[i]);
    }
    return e;
  });
  const Moments exact = moments(log_density, -8, 8);
  for (std::size_t i = 0; i < static_cast<std::size_t>(dimension); ++i)
    posterior.known.push_back(parameter(posterior, i, exact.mean, exact.sd));
  return posterior;
}

KnownPosterior kink() {
  constexpr double kAt = 0.5, kWidth = 0.1;
  return repeated(
      3, [](double x) { return -0.5 * x * x - std::abs(x - kAt) / kWidth; },
      [](double x) { return -x - (x > kAt ? 1 : -1) / kWidth; });
}

/// Growth rings: the value jumps where a ring begins, and the gradient knows nothing of it.
KnownPosterior rings(double jump) {
  const auto ring = [](double x) { return std::floor(8 * 0.5 * std::erfc(-x / std::numbers::sqrt2)); };
  return repeated(
      3, [=](double x) { return -0.5 * x * x - jump * std::pow(ring(x) - 3, 2); },
      [](double x) { return -x; });
}

/// N(0, 1) of which only the part above 1 is allowed.
KnownPosterior cliff(Eigen::Index dimension, double outside) {
  return repeated(
      dimension, [=](double x) { return x > 1 ? -0.5 * x * x : outside; }, [](double x) { return -x; });
}

/// The value is a number everywhere; the gradient is none in a fifth of the space.
KnownPosterior lost_gradient() {
  KnownPosterior posterior = in_coordinates(2, [](const Position& p) {
    Evaluation e{-0.5 * p.continuous.squaredNorm(), -p.continuous};
    if (p.continuous[0] > 0.84) e.gradient[1] = std::numeric_limits<double>::quiet_NaN();
    return e;
  });
  posterior.known = {parameter(posterior, 0, 0, 1), parameter(posterior, 1, 0, 1)};
  return posterior;
}

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

std::vector<Scenario> edge_scenarios() {
  const Demand plain{.refresh = 0};
  return {
      density_scenario("kink", "the log density has a corner at its summit", "quadrature", kink),
      density_scenario("rings", "jumps of 1 to 16 nats that no gradient tells of", "quadrature",
                       [] { return rings(1); }),
      density_scenario(
          "rings, no refresh", "the same without refresh moves", "quadrature", [] { return rings(1); },
          plain),
      density_scenario("cliff", "nothing below 1, where most of the prior is, in two dimensions",
                       "quadrature", [] { return cliff(2, -kInfinity); }),
      density_scenario("cliff in 8", "the same in eight, where no draw of the prior meets anything",
                       "quadrature", [] { return cliff(8, -kInfinity); }),
      density_scenario("not a number", "a log density that is no number where most of the prior is",
                       "quadrature",
                       [] {
                         KnownPosterior posterior = cliff(2, -kInfinity);
                         posterior.target = cliff(2, kNaN).target;
                         return posterior;
                       }),
      density_scenario("lost gradient", "a gradient that is no number in a fifth of the posterior",
                       "closed form", lost_gradient),
  };
}

}  // namespace patina
