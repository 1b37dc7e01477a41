#include "engine/sampling/shear.h"

#include <Eigen/QR>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

namespace patina {
namespace {

constexpr Eigen::Index kLeastDraws = 300;
constexpr double kLeastGain = 0.15;  // half the log of a ratio of variances: nats a draw

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

/// Knots at Harrell's quantiles for five; none where draws that repeat make two of them fall together.
std::optional<NaturalSplineBasis> basis_for(std::vector<double> values) {
  std::ranges::sort(values);
  Eigen::VectorXd knots(5);
  for (Eigen::Index k = 0; k < 5; ++k)
    knots[k] = values[static_cast<std::size_t>((0.05 + 0.225 * static_cast<double>(k)) *
                                               static_cast<double>(values.size() - 1))];
  const double least = 1e-3 * (knots[4] - knots[0]);
  for (Eigen::Index k = 1; k < 5; ++k)
    if (!(knots[k] - knots[k - 1] > least)) return std::nullopt;
  return NaturalSplineBasis(knots);
}

struct Regression {
  Eigen::MatrixXd coefficients;      ///< a column for every response
  Eigen::VectorXd residual_squares;  ///< summed over draws
};

/// Least squares. @param terms draws x terms @param responses draws x responses
Regression regress(const Eigen::MatrixXd& terms, const Eigen::MatrixXd& responses) {
  Regression result;
  result.coefficients = terms.colPivHouseholderQr().solve(responses);
  result.residual_squares = (responses - terms * result.coefficients).colwise().squaredNorm().transpose();
  return result;
}

struct Candidate {
  double gain = 0;
  std::shared_ptr<const Shear> shear;
};

/// The shear along one coordinate. @param draws draws x dimension
Candidate shear_along(Eigen::Index lead, const Eigen::MatrixXd& draws, const std::vector<bool>& fixed) {
  const auto basis = basis_for({draws.col(lead).begin(), draws.col(lead).end()});
  if (!basis) return {};
  Eigen::MatrixXd terms(draws.rows(), basis->size());
  for (Eigen::Index i = 0; i < draws.rows(); ++i) terms.row(i) = basis->values(draws(i, lead)).transpose();
  const Regression line = regress(terms.leftCols(2), draws);
  Regression spline = regress(terms, draws);
  double gain = 0;
  for (Eigen::Index j = 0; j < draws.cols(); ++j) {
    const bool takes_part = j != lead && (fixed.empty() || !fixed[static_cast<std::size_t>(j)]);
    const double gain_j =
        takes_part ? 0.5 * std::log(line.residual_squares[j] / spline.residual_squares[j]) : 0;
    if (gain_j >= kLeastGain && std::isfinite(gain_j))
      gain += gain_j;
    else
      spline.coefficients.col(j).setZero();
  }
  if (gain == 0) return {};
  return {gain, std::make_shared<const Shear>(lead, *basis, spline.coefficients)};
}

}  // namespace

Shear::Shear(Eigen::Index lead, NaturalSplineBasis basis, Eigen::MatrixXd coefficients)
    : lead_(lead), basis_(std::move(basis)), coefficients_(std::move(coefficients)) {
  assert(coefficients_.rows() == basis_.size() && coefficients_.col(lead_).isZero(0) &&
         "the lead leads itself nowhere");
}

Eigen::VectorXd Shear::straighten(const Eigen::VectorXd& x) const {
  return x - coefficients_.transpose() * basis_.values(x[lead_]);
}

Eigen::VectorXd Shear::bend(const Eigen::VectorXd& y) const {
  return y + coefficients_.transpose() * basis_.values(y[lead_]);
}

Eigen::VectorXd Shear::gradient_in_y(double lead, Eigen::VectorXd gradient) const {
  gradient[lead_] += slopes(lead).dot(gradient);
  return gradient;
}

Eigen::VectorXd Shear::gradient_in_x(double lead, Eigen::VectorXd gradient) const {
  gradient[lead_] -= slopes(lead).dot(gradient);
  return gradient;
}

Eigen::MatrixXd Shear::covariance_in_y(double lead, const Eigen::MatrixXd& covariance) const {
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Identity(covariance.rows(), covariance.cols());
  jacobian.col(lead_) -= slopes(lead);
  return jacobian * covariance * jacobian.transpose();
}

Eigen::MatrixXd Shear::covariance_in_x(double lead, const Eigen::MatrixXd& covariance) const {
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Identity(covariance.rows(), covariance.cols());
  jacobian.col(lead_) += slopes(lead);
  return jacobian * covariance * jacobian.transpose();
}

std::shared_ptr<const Shear> fit_shear(const std::vector<Eigen::MatrixXd>& chains,
                                       const std::vector<bool>& fixed) {
  const Eigen::MatrixXd draws = joined(chains).transpose();
  if (draws.rows() < kLeastDraws) return nullptr;
  Candidate best;
  for (Eigen::Index lead = 0; lead < draws.cols(); ++lead) {
    if (!fixed.empty() && fixed[static_cast<std::size_t>(lead)]) continue;
    Candidate candidate = shear_along(lead, draws, fixed);
    if (candidate.gain > best.gain) best = std::move(candidate);
  }
  return best.shear;
}

}  // namespace patina
