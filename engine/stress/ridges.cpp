#include <cmath>
#include <vector>

#include "engine/posterior/prior_transform.h"
#include "engine/stress/density.h"
#include "engine/stress/quadrature.h"
#include "engine/stress/scenarios.h"

namespace patina {
namespace {

/// Prior N(0, I); the sum of all coordinates is seen with an error: light x albedo, in logarithms.
KnownPosterior sum_seen(Eigen::Index dimension, double at, double error) {
  KnownPosterior posterior = in_coordinates(dimension, [=](const Position& p) {
    const double off = (p.continuous.sum() - at) / error;
    Evaluation e{-0.5 * p.continuous.squaredNorm() - 0.5 * off * off, -p.continuous};
    e.gradient.array() -= off / error;
    return e;
  });
  const double gain = 1 / (static_cast<double>(dimension) + error * error);
  for (std::size_t i = 0; i < static_cast<std::size_t>(dimension); ++i)
    posterior.known.push_back(parameter(posterior, i, at * gain, std::sqrt(1 - gain)));
  return posterior;
}

/// Prior N(0, I); x2 - x1^2 + 1 is seen with an error. Given x1, x2 is normal.
KnownPosterior bend_seen(double error) {
  KnownPosterior posterior = in_coordinates(2, [=](const Position& p) {
    const double x = p.continuous[0], y = p.continuous[1], off = (y - x * x + 1) / error;
    return Evaluation{-0.5 * (x * x + y * y + off * off),
                      Eigen::Vector2d(-x + 2 * x * off / error, -y - off / error)};
  });
  const double variance = 1 + error * error;
  const auto log_density = [=](double x) {
    return -0.5 * x * x - 0.5 * (x * x - 1) * (x * x - 1) / variance;
  };
  const Moments x = moments(log_density, -8, 8);
  const Moments bend = moments_of([=](double v) { return (v * v - 1) / variance; }, log_density, -8, 8);
  posterior.known = {parameter(posterior, 0, x.mean, x.sd),
                     parameter(posterior, 1, bend.mean, std::hypot(bend.sd, error / std::sqrt(variance)))};
  return posterior;
}

/// Two parameters of prior TN(0.5, 0.25^2; 0, 1) whose product is seen with an error: a hyperbola that ends
/// at two bounds.
KnownPosterior product_seen(double at, double error) {
  const TruncatedNormal prior{0.5, 0.25, 0, 1};
  const PriorTransform transform(prior);
  KnownPosterior posterior = in_coordinates(2, [=](const Position& p) {
    const double u = p.continuous[0], v = p.continuous[1], a = transform.value(u), b = transform.value(v);
    const double off = (a * b - at) / error;
    return Evaluation{-0.5 * (u * u + v * v + off * off),
                      Eigen::Vector2d(-u - off / error * b * transform.derivative(u),
                                      -v - off / error * a * transform.derivative(v))};
  });
  for (Parameter& each : posterior.table.continuous) each.prior = prior;
  posterior.values = [=](const Position& p) {
    return ParameterValues{{transform.value(p.continuous[0]), transform.value(p.continuous[1])}, {}};
  };
  // Given a, the product a b is seen through b: a normal of b, cut to [0, 1].
  const auto log_density = [=](double a) {
    const double width = error / a, variance = prior.sd * prior.sd + width * width;
    const double off = at / a - prior.mean, mean = prior.mean + off * prior.sd * prior.sd / variance;
    const double sd = prior.sd * width / std::sqrt(variance);
    const double inside =
        0.5 * (std::erf((1 - mean) / (sd * std::sqrt(2.0))) + std::erf(mean / (sd * std::sqrt(2.0))));
    const double own = (a - prior.mean) / prior.sd;
    return -0.5 * own * own - 0.5 * off * off / variance - 0.5 * std::log(variance) - std::log(a) +
           std::log(std::max(inside, 1e-300));
  };
  const Moments a = moments(log_density, 0, 1);
  posterior.known = {parameter(posterior, 0, a.mean, a.sd), parameter(posterior, 1, a.mean, a.sd)};
  return posterior;
}

/// x1 ~ N(0, 1); the others' sd is 0.3 exp(1.2 x1): wide at one end, a thousandth of that at the other.
KnownPosterior funnel(Eigen::Index dimension) {
  KnownPosterior posterior = in_coordinates(dimension, [=](const Position& p) {
    const double x = p.continuous[0], others = static_cast<double>(dimension - 1);
    const double log_sd = std::log(0.3) + 1.2 * x, precision = std::exp(-2 * log_sd);
    const double squares = p.continuous.tail(dimension - 1).squaredNorm() * precision;
    Evaluation e{-0.5 * x * x - others * log_sd - 0.5 * squares, -precision * p.continuous};
    e.gradient[0] = -x - 1.2 * others + 1.2 * squares;
    return e;
  });
  posterior.known = {parameter(posterior, 0, 0, 1)};
  return posterior;
}

}  // namespace

std::vector<Scenario> ridge_scenarios() {
  const Demand plain{.refresh = 0};
  return {
      density_scenario("ridge", "eight parameters whose sum is seen to a thousandth (light x albedo)",
                       "closed form", [] { return sum_seen(8, 1, 1e-3); }),
      density_scenario("ridge in 23", "the same with as many parameters as the largest material, to 1e-4",
                       "closed form", [] { return sum_seen(23, 1, 1e-4); }),
      density_scenario("bent ridge", "a curved ridge a twentieth wide (similar media)", "quadrature",
                       [] { return bend_seen(0.05); }),
      density_scenario("bent ridge, thin", "a curved ridge a two-hundredth wide", "quadrature",
                       [] { return bend_seen(0.005); }),
      density_scenario("product", "a hyperbola between two bounds (scale x frequency), seen to 1 %",
                       "quadrature", [] { return product_seen(0.2, 0.002); }),
      density_scenario("funnel", "a spread that depends on another parameter", "closed form",
                       [] { return funnel(6); }),
      density_scenario(
          "funnel, no refresh", "the same without refresh moves", "closed form", [] { return funnel(6); },
          plain),
  };
}

}  // namespace patina
