#include "engine/sampling/straightening.h"

#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

namespace patina {
namespace {

constexpr Eigen::Index kLeastDraws = 300;

/// How finely a ridge is followed. More knots follow a kink where five cut its corner, and need more draws to
/// tell a bend from chance.
struct Detail {
  Eigen::Index knots;
  Eigen::Index least_draws;
  double least_gain;  ///< nats a draw
};
constexpr std::array kDetails{Detail{9, 1000, 0.3}, Detail{5, kLeastDraws, 0.2}};

/// Draws side by side: dimension x all draws.
Eigen::MatrixXd joined(const std::vector<Eigen::MatrixXd>& chains) {
  Eigen::Index draws = 0;
  for (const Eigen::MatrixXd& chain : chains) draws += chain.cols();
  Eigen::MatrixXd all(chains.empty() ? 0 : chains.front().rows(), draws);
  Eigen::Index next = 0;
  for (const Eigen::MatrixXd& chain : chains) {
    all.middleCols(next, chain.cols()) = chain;
    next += chain.cols();
  }
  return all;
}

/// Knots at quantiles, the outer ones near the ends: beyond them the map knows no width. None where draws
/// that repeat make two of them fall together.
std::optional<NaturalSplineBasis> basis_for(std::vector<double> values, Eigen::Index count) {
  constexpr double kEnd = 0.01;
  std::ranges::sort(values);
  Eigen::VectorXd knots(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const double even = static_cast<double>(k) / static_cast<double>(count - 1);
    const double quantile = std::clamp(even, kEnd, 1 - kEnd);
    knots[k] = values[static_cast<std::size_t>(quantile * static_cast<double>(values.size() - 1))];
  }
  const double least = 1e-3 * (knots[count - 1] - knots[0]);
  for (Eigen::Index k = 1; k < count; ++k)
    if (!(knots[k] - knots[k - 1] > least)) return std::nullopt;
  return NaturalSplineBasis(knots);
}

/// Least squares. @param terms draws x terms @param response draws @return a coefficient per term
Eigen::VectorXd regress(const Eigen::MatrixXd& terms, const Eigen::VectorXd& response) {
  return terms.colPivHouseholderQr().solve(response);
}

/// One coordinate along the lead.
struct Bend {
  Eigen::VectorXd middle, log_width;
  double gain = 0;  ///< in nats a draw, over a line of one width
};

/// @param terms draws x basis.size(), of which the first two are 1 and the lead
/// @param inside the same with the lead kept within the outer knots
Bend fit_bend(const Eigen::MatrixXd& terms, const Eigen::MatrixXd& inside, const Eigen::VectorXd& x) {
  constexpr double kFloor = 1e-3;  // of the mean square: the logs of the smallest squares say nothing
  const Eigen::MatrixXd line = terms.leftCols(2);
  const double line_square = (x - line * regress(line, x)).squaredNorm() / static_cast<double>(x.size());
  Bend bend;
  bend.middle = regress(terms, x);
  const Eigen::ArrayXd squares = (x - terms * bend.middle).array().square();
  bend.log_width = regress(inside, 0.5 * (squares + kFloor * squares.mean()).log().matrix());
  Eigen::ArrayXd log_widths = (inside * bend.log_width).array();
  // A mean of logs is below the log of a mean: the widths are scaled so that y has mean square 1.
  const double scale = 0.5 * std::log((squares * (-2 * log_widths).exp()).mean());
  bend.log_width[0] += scale;
  log_widths += scale;
  bend.gain = 0.5 * std::log(line_square) - log_widths.mean();
  return bend;
}

struct Candidate {
  double gain = 0;
  std::shared_ptr<const Straightening> map;
};

/// The map along one coordinate. @param draws draws x dimension
Candidate straightening_along(Eigen::Index lead, const Eigen::MatrixXd& draws, const std::vector<bool>& fixed,
                              const Detail& detail) {
  const auto basis = basis_for({draws.col(lead).begin(), draws.col(lead).end()}, detail.knots);
  if (!basis) return {};
  Eigen::MatrixXd terms(draws.rows(), basis->size()), inside = terms;
  for (Eigen::Index i = 0; i < draws.rows(); ++i) {
    terms.row(i) = basis->values(draws(i, lead)).transpose();
    inside.row(i) = basis->values(basis->clamped(draws(i, lead))).transpose();
  }
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(basis->size(), draws.cols());
  Straightening::Coefficients coefficients{none, none};
  double gain = 0;
  for (Eigen::Index j = 0; j < draws.cols(); ++j) {
    if (j == lead || (!fixed.empty() && fixed[static_cast<std::size_t>(j)])) continue;
    const Bend bend = fit_bend(terms, inside, draws.col(j));
    if (!std::isfinite(bend.gain) || bend.gain < detail.least_gain) continue;
    gain += bend.gain;
    coefficients.middle.col(j) = bend.middle;
    coefficients.log_width.col(j) = bend.log_width;
  }
  if (gain == 0) return {};
  return {gain, std::make_shared<const Straightening>(lead, *basis, coefficients)};
}

}  // namespace

Straightening::Straightening(Eigen::Index lead, NaturalSplineBasis basis, Coefficients coefficients)
    : lead_(lead), basis_(std::move(basis)), coefficients_(std::move(coefficients)) {
  assert(coefficients_.middle.rows() == basis_.size() && coefficients_.log_width.rows() == basis_.size());
  assert(coefficients_.middle.col(lead_).isZero(0) && coefficients_.log_width.col(lead_).isZero(0) &&
         "the lead leads itself nowhere");
}

Eigen::VectorXd Straightening::log_width(double lead) const {
  return coefficients_.log_width.transpose() * basis_.values(basis_.clamped(lead));
}

Eigen::VectorXd Straightening::middle_slope(double lead) const {
  return coefficients_.middle.transpose() * basis_.slopes(lead);
}

Eigen::VectorXd Straightening::log_width_slope(double lead) const {
  if (basis_.clamped(lead) != lead) return Eigen::VectorXd::Zero(coefficients_.log_width.cols());
  return coefficients_.log_width.transpose() * basis_.slopes(lead);
}

Eigen::VectorXd Straightening::straighten(const Eigen::VectorXd& x) const {
  return (x - middle(x[lead_])).cwiseProduct((-log_width(x[lead_])).array().exp().matrix());
}

Eigen::VectorXd Straightening::bend(const Eigen::VectorXd& y) const {
  return y.cwiseProduct(log_width(y[lead_]).array().exp().matrix()) + middle(y[lead_]);
}

Evaluation Straightening::density_of_y(const Eigen::VectorXd& y, const Evaluation& of_x) const {
  const double lead = y[lead_];
  if (of_x.gradient.size() == 0) return {of_x.log_density + log_width(lead).sum(), {}};
  const Eigen::VectorXd width = log_width(lead).array().exp(), widening = log_width_slope(lead);
  Evaluation of_y{of_x.log_density + log_width(lead).sum(), of_x.gradient.cwiseProduct(width)};
  of_y.gradient[lead_] +=
      of_x.gradient.dot(middle_slope(lead)) + of_y.gradient.cwiseProduct(y).dot(widening) + widening.sum();
  return of_y;
}

Evaluation Straightening::density_of_x(const Eigen::VectorXd& y, const Evaluation& of_y) const {
  const double lead = y[lead_];
  if (of_y.gradient.size() == 0) return {of_y.log_density - log_width(lead).sum(), {}};
  const Eigen::VectorXd width = log_width(lead).array().exp(), widening = log_width_slope(lead);
  Evaluation of_x{of_y.log_density - log_width(lead).sum(), of_y.gradient.cwiseQuotient(width)};
  // Neither the middle nor the width of the lead itself has a slope, so that its own entry plays no part.
  of_x.gradient[lead_] -=
      of_x.gradient.dot(middle_slope(lead)) + of_y.gradient.cwiseProduct(y).dot(widening) + widening.sum();
  return of_x;
}

Eigen::MatrixXd Straightening::covariance_in_y(double lead, const Eigen::MatrixXd& covariance) const {
  Eigen::MatrixXd jacobian = (-log_width(lead)).array().exp().matrix().asDiagonal();
  jacobian.col(lead_) -= middle_slope(lead).cwiseProduct((-log_width(lead)).array().exp().matrix());
  return jacobian * covariance * jacobian.transpose();
}

Eigen::MatrixXd Straightening::covariance_in_x(double lead, const Eigen::MatrixXd& covariance) const {
  Eigen::MatrixXd jacobian = log_width(lead).array().exp().matrix().asDiagonal();
  jacobian.col(lead_) += middle_slope(lead);
  return jacobian * covariance * jacobian.transpose();
}

std::shared_ptr<const Straightening> fit_straightening(const std::vector<Eigen::MatrixXd>& chains,
                                                       const std::vector<bool>& fixed) {
  const Eigen::MatrixXd draws = joined(chains).transpose();
  Candidate best;
  for (const Detail& detail : kDetails) {
    if (draws.rows() < detail.least_draws || best.map) continue;
    for (Eigen::Index lead = 0; lead < draws.cols(); ++lead) {
      if (!fixed.empty() && fixed[static_cast<std::size_t>(lead)]) continue;
      Candidate candidate = straightening_along(lead, draws, fixed, detail);
      if (candidate.gain > best.gain) best = std::move(candidate);
    }
  }
  return best.map;
}

}  // namespace patina
