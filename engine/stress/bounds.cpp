#include <cmath>
#include <vector>

#include "engine/posterior/prior_transform.h"
#include "engine/stress/density.h"
#include "engine/stress/quadrature.h"
#include "engine/stress/scenarios.h"

namespace patina {
namespace {

const TruncatedNormal kPrior{0.5, 0.25, 0, 1};

/// What the photo says of a parameter: N(at, error^2).
struct Sight {
  double at, error;
};

/// Independent parameters of one prior, each seen once: every posterior is a truncated normal.
KnownPosterior seen(const std::vector<Sight>& sights) {
  const PriorTransform transform(kPrior);
  const auto log_density = [sights, transform](const Position& p) {
    Evaluation e{-0.5 * p.continuous.squaredNorm(), -p.continuous};
    for (std::size_t i = 0; i < sights.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      const double off = (transform.value(p.continuous[k]) - sights[i].at) / sights[i].error;
      e.log_density -= 0.5 * off * off;
      e.gradient[k] -= off / sights[i].error * transform.derivative(p.continuous[k]);
    }
    return e;
  };
  KnownPosterior posterior = in_coordinates(std::ssize(sights), log_density);
  posterior.values = [transform](const Position& p) {
    ParameterValues values;
    for (const double u : p.continuous) values.continuous.push_back(transform.value(u));
    return values;
  };
  for (std::size_t i = 0; i < sights.size(); ++i) {
    posterior.table.continuous[i].prior = kPrior;
    const double prior = 1 / (kPrior.sd * kPrior.sd), sight = 1 / (sights[i].error * sights[i].error);
    const double mean = (kPrior.mean * prior + sights[i].at * sight) / (prior + sight);
    const Moments exact = truncated_normal(mean, 1 / std::sqrt(prior + sight), kPrior.low, kPrior.high);
    posterior.known.push_back(parameter(posterior, i, exact.mean, exact.sd));
  }
  return posterior;
}

}  // namespace

std::vector<Scenario> bound_scenarios() {
  return {
      density_scenario("bound", "four parameters of which three are piled at a bound of their prior",
                       "closed form",
                       [] {
                         return seen({{0.5, 0.2}, {1.1, 0.2}, {1.3, 0.1}, {1.1, 0.02}});
                       }),
      density_scenario("beyond", "twelve parameters that the photo wants far outside their prior",
                       "closed form",
                       [] {
                         return seen(std::vector<Sight>(12, {-1, 0.05}));
                       }),
  };
}

}  // namespace patina
