#include "engine/posterior/regressed_likelihood.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/posterior/local_regression.h"
#include "engine/sampling/archive.h"

namespace patina {
namespace {

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
  // No direction is known to the last digit, or less well than before the photo.
  const Eigen::VectorXd variances = solver.eigenvalues().cwiseMax(1e-8).cwiseMin(1.0);
  const Eigen::MatrixXd& axes = solver.eigenvectors();
  precision_ = axes * (variances.cwiseInverse().array() - 1).matrix().asDiagonal() * axes.transpose();
  pull_ = axes * variances.cwiseInverse().asDiagonal() * axes.transpose() * local.mean;
}

RegressedLikelihood RegressedLikelihood::widened(double times) const {
  RegressedLikelihood wider = *this;
  wider.precision_ /= times;
  wider.pull_ /= times;
  return wider;
}

Evaluation RegressedLikelihood::evaluate(const Eigen::VectorXd& coordinates) const {
  const Eigen::VectorXd v = region_.offset(coordinates);
  const double radius = trusted_radius(v.size()), distance = v.norm();
  double misfit = v.dot(0.5 * precision_ * v - pull_);
  Eigen::VectorXd slope = precision_ * v - pull_;
  if (distance > radius) {
    misfit += 0.5 * (distance - radius) * (distance - radius);
    slope += (distance - radius) / distance * v;
  }
  return {-misfit, -region_.factor.triangularView<Eigen::Lower>().transpose().solve(slope)};
}

bool RegressedLikelihood::is_of(Eigen::Index coordinates) const {
  const bool sized = region_.centre.size() == coordinates && region_.factor.rows() == coordinates &&
                     region_.factor.cols() == coordinates && precision_.rows() == coordinates &&
                     precision_.cols() == coordinates && pull_.size() == coordinates;
  return sized && region_.centre.allFinite() && region_.factor.allFinite() &&
         (region_.factor.diagonal().array() > 0).all() && precision_.allFinite() && pull_.allFinite();
}

void RegressedLikelihood::serialise(Archive& archive) {
  archive(region_.centre, region_.factor, precision_, pull_);
}

}  // namespace patina
