#include <cmath>
#include <vector>

#include "engine/stress/density.h"
#include "engine/stress/quadrature.h"
#include "engine/stress/scenarios.h"

namespace patina {
namespace {

constexpr Eigen::Index kUnequalDimension = 8;

double sd_of(Eigen::Index i) { return 0.05 * std::pow(1.4, static_cast<double>(i)); }

/// Independent normals of sds from 0.05 to 0.5.
KnownPosterior unequal() {
  KnownPosterior posterior = in_coordinates(kUnequalDimension, [](const Position& p) {
    Evaluation e{0, p.continuous};
    for (Eigen::Index i = 0; i < kUnequalDimension; ++i) {
      const double off = p.continuous[i] / sd_of(i);
      e.log_density -= 0.5 * off * off;
      e.gradient[i] = -off / sd_of(i);
    }
    return e;
  });
  for (Eigen::Index i = 0; i < kUnequalDimension; ++i)
    posterior.known.push_back(parameter(posterior, static_cast<std::size_t>(i), 0, sd_of(i)));
  return posterior;
}

/// A peak whose slope is gone a few sds away, on the prior: nearly all mass is in the peak, and nothing far
/// from it tells where it is.
KnownPosterior peak_in_a_plain(double height, double sd) {
  KnownPosterior posterior = in_coordinates(3, [=](const Position& p) {
    const Eigen::VectorXd off = (p.continuous.array() - 0.7) / sd;
    const double bell = height * std::exp(-0.5 * off.squaredNorm());
    return Evaluation{bell - 0.5 * p.continuous.squaredNorm(), -bell / sd * off - p.continuous};
  });
  // The plain's share of the mass is about e^-height (height / sd^2)^1.5, and across the peak the prior is a
  // slope of 0.7: what is left is a function of the distance from the summit.
  const auto log_density = [=](double r) { return height * std::exp(-0.5 * r * r) + 2 * std::log(r); };
  const double square = moments_of([](double r) { return r * r; }, log_density, 0, 2).mean;
  const double variance = sd * sd * square / 3;
  for (std::size_t i = 0; i < 3; ++i)
    posterior.known.push_back(parameter(posterior, i, 0.7 * (1 - variance), std::sqrt(variance)));
  return posterior;
}

Position at(double place) { return {Eigen::VectorXd::Constant(kUnequalDimension, place), {}}; }

}  // namespace

std::vector<Scenario> start_scenarios() {
  const auto from = [](double place) { return [=](Rng&) { return at(place); }; };
  const auto try_unequal = [](const char* name, const char* what, const Demand& demand) {
    return density_scenario(name, what, "closed form", unequal, demand);
  };
  const Start prior = [](Rng& rng) { return Position{rng.normals(3), {}}; };
  return {
      try_unequal("step too long", "sds taken for 100 times what they are at the start of warm-up",
                  {.metric_factor = 100}),
      try_unequal("step too short", "sds taken for a hundredth of what they are", {.metric_factor = 0.01}),
      try_unequal("far tail", "all chains begin 160 sds away", {.start = from(8)}),
      try_unequal("very far tail", "all chains begin 20000 sds away", {.start = from(1000)}),
      density_scenario("plain", "chains begin on a plain that hides a peak of 60 nats", "quadrature",
                       [] { return peak_in_a_plain(60, 0.2); }, {.start = prior}),
      try_unequal("no warm-up", "draws from the first step on", {.warmup = 0}),
      try_unequal("no warm-up, far tail", "the same from far away", {.warmup = 0, .start = from(8)}),
      try_unequal("no warm-up, step too long", "the same with sds taken for 100 times what they are",
                  {.warmup = 0, .metric_factor = 100}),
      try_unequal("one draw", "four chains of one draw", {.draws = 1}),
      try_unequal("three draws", "four chains of three draws", {.draws = 3}),
      try_unequal("one chain", "a single chain", {.chains = 1}),
      try_unequal("64 chains", "64 chains of 100 draws", {.chains = 64, .draws = 100}),
  };
}

}  // namespace patina
