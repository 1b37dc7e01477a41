#include <cmath>
#include <numbers>
#include <vector>

#include "engine/stress/density.h"
#include "engine/stress/quadrature.h"
#include "engine/stress/scenarios.h"

namespace patina {
namespace {

/// A round normal cloud of unit mass times `weight`.
struct Cloud {
  double weight, at, sd;  ///< every coordinate is about `at`
};

double log_density_of(const Cloud& cloud, const Eigen::VectorXd& x) {
  const auto dimension = static_cast<double>(x.size());
  return std::log(cloud.weight) - dimension * std::log(cloud.sd) -
         0.5 * (x.array() - cloud.at).square().sum() / (cloud.sd * cloud.sd);
}

Eigen::VectorXd gradient_of(const Cloud& cloud, const Eigen::VectorXd& x) {
  return (cloud.at - x.array()) / (cloud.sd * cloud.sd);
}

Moments pooled(const Cloud& a, const Cloud& b) {
  const double mean = a.weight * a.at + b.weight * b.at;
  const double square = a.weight * (a.sd * a.sd + a.at * a.at) + b.weight * (b.sd * b.sd + b.at * b.at);
  return {mean, std::sqrt(square - mean * mean)};
}

/// A cloud for each of two levels.
KnownPosterior two_levels(const Cloud& first, const Cloud& second) {
  KnownPosterior posterior = in_coordinates(
      2,
      [=](const Position& p) {
        const Cloud& cloud = p.discrete[0] == 0 ? first : second;
        return Evaluation{log_density_of(cloud, p.continuous), gradient_of(cloud, p.continuous)};
      },
      {2});
  const Moments x = pooled(first, second);
  posterior.known = {choice(posterior, 0, 1, second.weight), parameter(posterior, 0, x.mean, x.sd)};
  return posterior;
}

KnownPosterior two_clouds(Eigen::Index dimension, const Cloud& first, const Cloud& second) {
  KnownPosterior posterior = in_coordinates(dimension, [=](const Position& p) {
    const double a = log_density_of(first, p.continuous), b = log_density_of(second, p.continuous);
    const double highest = std::max(a, b), share = 1 / (1 + std::exp(b - a));
    return Evaluation{
        highest + std::log(std::exp(a - highest) + std::exp(b - highest)),
        share * gradient_of(first, p.continuous) + (1 - share) * gradient_of(second, p.continuous)};
  });
  const Moments x = pooled(first, second);
  for (std::size_t i = 0; i < static_cast<std::size_t>(dimension); ++i)
    posterior.known.push_back(parameter(posterior, i, x.mean, x.sd));
  return posterior;
}

/// A shift on a circle that looks alike after every third of it, and five parameters that the photo knows.
KnownPosterior periodic_shift(double sharpness) {
  constexpr int kSeen = 5;
  constexpr double kTurns = 3;
  const auto angle = [](double u) {
    return 2 * std::numbers::pi * kTurns * 0.5 * std::erfc(-u / std::numbers::sqrt2);
  };
  KnownPosterior posterior = in_coordinates(1 + kSeen, [=](const Position& p) {
    const double u = p.continuous[0];
    const double density = std::exp(-0.5 * u * u) / std::sqrt(2 * std::numbers::pi);
    Evaluation e{-0.5 * p.continuous.squaredNorm() + sharpness * std::cos(angle(u) - 1), -p.continuous};
    e.gradient[0] -= sharpness * std::sin(angle(u) - 1) * 2 * std::numbers::pi * kTurns * density;
    e.log_density -= 50 * p.continuous.tail(kSeen).squaredNorm();
    e.gradient.tail(kSeen) -= 100 * p.continuous.tail(kSeen);
    return e;
  });
  const Moments shift =
      moments([=](double u) { return -0.5 * u * u + sharpness * std::cos(angle(u) - 1); }, -8, 8);
  posterior.known = {parameter(posterior, 0, shift.mean, shift.sd),
                     parameter(posterior, 1, 0, std::sqrt(1.0 / 101))};
  return posterior;
}

/// Beyond any method: a cloud that neither search nor chain meets.
Scenario hidden(Scenario scenario) {
  scenario.is_limit = true;
  return scenario;
}

}  // namespace

std::vector<Scenario> mode_scenarios() {
  const Demand plain{.refresh = 0};
  return {
      density_scenario("two levels", "a choice between two clouds twelve sds apart", "closed form",
                       [] {
                         return two_levels({0.3, -1.2, 0.2}, {0.7, 1.2, 0.2});
                       }),
      density_scenario("two levels, near", "a choice between two clouds that overlap", "closed form",
                       [] {
                         return two_levels({0.3, -0.2, 0.3}, {0.7, 0.2, 0.3});
                       }),
      density_scenario("two clouds", "two clouds in four dimensions, twenty sds apart in each", "closed form",
                       [] {
                         return two_clouds(4, {0.3, -1.5, 0.15}, {0.7, 1.5, 0.15});
                       }),
      density_scenario("shift", "a shift that looks alike after every third of a turn", "quadrature",
                       [] { return periodic_shift(30); }),
      density_scenario(
          "shift, no refresh", "the same without refresh moves", "quadrature",
          [] { return periodic_shift(30); }, plain),
      density_scenario("needle", "half of the mass in a cloud a tenth as wide as the other", "closed form",
                       [] {
                         return two_clouds(2, {0.5, 0, 0.5}, {0.5, 1, 0.05});
                       }),
      hidden(density_scenario("hidden needle", "half of the mass in a cloud a fiftieth as wide as the other",
                              "closed form",
                              [] {
                                return two_clouds(3, {0.5, 0, 0.5}, {0.5, 1, 0.01});
                              })),
  };
}

}  // namespace patina
