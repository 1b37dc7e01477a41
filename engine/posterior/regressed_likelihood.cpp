#include "engine/posterior/regressed_likelihood.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/posterior/local_regression.h"
#include "engine/sampling/archive.h"

namespace patina {
namespace {

// A direction that keeps more of its variance is not told: where it would be seen is all but chance.
constexpr double kTold = 0.9;

double trusted_radius(Eigen::Index dimension) { return std::sqrt(static_cast<double>(dimension)) + 3; }

/// The correlations of columns of variance 1, shrunk to none by as much as makes the expected squared error
/// least (Ledoit & Wolf 2004; Schaefer & Strimmer 2005).
Eigen::MatrixXd shrunk_correlations(const Eigen::MatrixXd& columns) {
  const auto n = static_cast<double>(columns.cols());
  const Eigen::MatrixXd found = columns * columns.transpose() / n;
  const Eigen::MatrixXd squares = columns.cwiseAbs2() * columns.cwiseAbs2().transpose() / n;
  const Eigen::MatrixXd errors = (squares - found.cwiseAbs2()) / n;  // variances of what was found
  const Eigen::MatrixXd variances = found.diagonal().asDiagonal();
  const double error = errors.sum() - errors.trace(), all = (found - variances).squaredNorm();
  const double share = std::clamp(error / std::max(all, 1e-300), 0.0, 1.0);
  return (1 - share) * found + share * variances;
}

Eigen::MatrixXd covariance_of(const LocalRegression& of) {
  const Eigen::VectorXd sds =
      (of.errors.rowwise().squaredNorm() / static_cast<double>(of.errors.cols())).cwiseMax(1e-20).cwiseSqrt();
  return of.sd.asDiagonal() * shrunk_correlations(sds.cwiseInverse().asDiagonal() * of.errors) *
         of.sd.asDiagonal();
}

}  // namespace

RegressedLikelihood::RegressedLikelihood(const Region& region, const Eigen::MatrixXd& offsets,
                                         const Eigen::MatrixXd& scores, const Eigen::VectorXd& observed)
    : region_(region) {
  assert(offsets.cols() >= 3 * (1 + scores.rows()));
  const LocalRegression local = local_regression(offsets, scores, observed);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance_of(local));
  const Eigen::MatrixXd& axes = solver.eigenvectors();
  // No direction is known to the last digit, or less well than before the photo.
  const Eigen::ArrayXd variances = solver.eigenvalues().array().cwiseMax(1e-8).cwiseMin(1.0);
  const Eigen::Array<bool, Eigen::Dynamic, 1> told = variances < kTold;
  const Eigen::ArrayXd along = (axes.transpose() * local.mean).array();
  told_ = told.count();
  precision_ = axes * told.select((1 - variances) / variances, 0.0).matrix().asDiagonal() * axes.transpose();
  place_ = axes * told.select(along / (1 - variances), 0.0).matrix();
}

RegressedLikelihood RegressedLikelihood::widened(double times) const {
  RegressedLikelihood wider = *this;
  wider.precision_ /= times;
  return wider;
}

RegressedLikelihood RegressedLikelihood::doubted() const {
  const Eigen::MatrixXd of_prior = region_.factor.transpose() * region_.factor;
  RegressedLikelihood less = *this;
  less.precision_ = precision_ * (of_prior + precision_).llt().solve(precision_);
  return less;
}

RegressedLikelihood RegressedLikelihood::heavy_tailed(double degrees_of_freedom) const {
  RegressedLikelihood heavier = *this;
  heavier.degrees_ = degrees_of_freedom;
  return heavier;
}

Evaluation RegressedLikelihood::evaluate(const Eigen::VectorXd& coordinates) const {
  const Eigen::VectorXd v = region_.offset(coordinates);
  const Eigen::VectorXd pull = precision_ * (v - place_);
  const double square = pull.dot(v - place_);
  const bool normal = std::isinf(degrees_);
  const double freedom = degrees_ + static_cast<double>(told_);
  double misfit = 0.5 * (normal ? square : freedom * std::log1p(square / degrees_));
  Eigen::VectorXd slope = normal ? pull : Eigen::VectorXd(freedom / (degrees_ + square) * pull);
  const double radius = trusted_radius(v.size()), distance = v.norm();
  if (distance > radius) {
    misfit += 0.5 * (distance - radius) * (distance - radius);
    slope += (distance - radius) / distance * v;
  }
  return {-misfit, -region_.factor.triangularView<Eigen::Lower>().transpose().solve(slope)};
}

bool RegressedLikelihood::is_of(Eigen::Index coordinates) const {
  const bool sized = region_.centre.size() == coordinates && region_.factor.rows() == coordinates &&
                     region_.factor.cols() == coordinates && precision_.rows() == coordinates &&
                     precision_.cols() == coordinates && place_.size() == coordinates;
  return sized && region_.centre.allFinite() && region_.factor.allFinite() &&
         (region_.factor.diagonal().array() > 0).all() && precision_.allFinite() && place_.allFinite() &&
         degrees_ > 0 && told_ >= 0 && told_ <= coordinates;
}

void RegressedLikelihood::serialise(Archive& archive) {
  archive(region_.centre, region_.factor, precision_, place_, told_, degrees_);
}

}  // namespace patina
