#include "engine/posterior/prior_transform.h"

#include <unsupported/Eigen/SpecialFunctions>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <sstream>

#include "engine/error.h"

namespace patina {
namespace {

constexpr double kCut = 8.0;

double normal_cdf(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

/// Phi^-1 from both tails' masses, whichever is the smaller, so that neither end loses digits.
double normal_quantile(double lower, double upper) {
  return lower < upper ? Eigen::numext::ndtri(lower) : -Eigen::numext::ndtri(upper);
}

[[noreturn]] void refuse(const TruncatedNormal& prior, const char* why) {
  std::ostringstream sentence;
  sentence << "The prior mean " << prior.mean << ", sd " << prior.sd << ", low " << prior.low << ", high "
           << prior.high << " cannot be used: " << why << ".";
  throw UserError(sentence.str());
}

}  // namespace

PriorTransform::PriorTransform(const TruncatedNormal& prior) : prior_(prior) {
  for (const double number : {prior.mean, prior.sd, prior.low, prior.high})
    if (!std::isfinite(number)) refuse(prior, "its four numbers must be finite");
  if (!(prior.sd > 0)) refuse(prior, "the sd must be above 0");
  if (!(prior.low < prior.high)) refuse(prior, "low must be below high");
  const double a = (prior.low - prior.mean) / prior.sd;
  const double b = (prior.high - prior.mean) / prior.sd;
  below_ = normal_cdf(a);
  above_ = normal_cdf(-b);
  inside_ = a > 0 ? normal_cdf(-a) - normal_cdf(-b) : normal_cdf(b) - normal_cdf(a);
  if (!(inside_ > 1e-12)) refuse(prior, "the range lies too far from the mean, so bring them together");
}

double PriorTransform::standard_score(double u) const {
  return normal_quantile(below_ + normal_cdf(u) * inside_, above_ + normal_cdf(-u) * inside_);
}

double PriorTransform::value(double u) const {
  const double z = standard_score(std::clamp(u, -kCut, kCut));
  return std::clamp(prior_.mean + prior_.sd * z, prior_.low, prior_.high);
}

double PriorTransform::derivative(double u) const {
  if (!(std::abs(u) <= kCut)) return 0;
  const double z = standard_score(u);
  return prior_.sd * inside_ * std::exp(0.5 * (z * z - u * u));
}

double PriorTransform::coordinate(double t) const {
  const double inside_t = std::clamp(t, prior_.low, prior_.high);
  const double z = (inside_t - prior_.mean) / prior_.sd;
  const double lower = std::max((normal_cdf(z) - below_) / inside_, 0.0);
  const double upper = std::max((normal_cdf(-z) - above_) / inside_, 0.0);
  if (lower <= 0) return -kCut;
  if (upper <= 0) return kCut;
  return std::clamp(normal_quantile(lower, upper), -kCut, kCut);
}

std::vector<double> values_at(const ParameterTable& table, const Eigen::VectorXd& coordinates) {
  assert(coordinates.size() == std::ssize(table.continuous));
  std::vector<double> values;
  for (const Parameter& parameter : table.continuous)
    values.push_back(PriorTransform(parameter.prior).value(coordinates[std::ssize(values)]));
  return values;
}

double truncated_sd(const TruncatedNormal& prior) {
  const double a = (prior.low - prior.mean) / prior.sd;
  const double b = (prior.high - prior.mean) / prior.sd;
  const auto density = [](double z) { return std::exp(-0.5 * z * z) / std::sqrt(2 * std::numbers::pi); };
  const double inside = a > 0 ? normal_cdf(-a) - normal_cdf(-b) : normal_cdf(b) - normal_cdf(a);
  const double shift = (density(a) - density(b)) / inside;
  const double spread = (a * density(a) - b * density(b)) / inside;
  return prior.sd * std::sqrt(std::max(1 + spread - shift * shift, 0.0));
}

}  // namespace patina
