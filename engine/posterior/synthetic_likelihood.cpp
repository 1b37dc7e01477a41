#include "engine/posterior/synthetic_likelihood.h"

#include <Eigen/Cholesky>

#include <cassert>
#include <cmath>

#include "engine/posterior/least_squares.h"
#include "engine/posterior/log_variances.h"
#include "engine/sampling/archive.h"

namespace patina {
namespace {

constexpr Eigen::Index kPhotosAProduct = 3, kPhotosASquare = 2;
constexpr Eigen::Index kPhotosAGrowth = 10;  // of the variance, along one coordinate

double trusted_radius(Eigen::Index dimension) { return std::sqrt(static_cast<double>(dimension)) + 3; }

}  // namespace

Eigen::Index SyntheticLikelihood::least_photos(Eigen::Index coordinates, Eigen::Index scores) {
  return kPhotosASquare * QuadraticFeatures(coordinates, false).size() + 2 * scores;
}

SyntheticLikelihood::SyntheticLikelihood(const Region& region, const Eigen::MatrixXd& offsets,
                                         const Eigen::MatrixXd& scores, const Eigen::VectorXd& observed)
    : region_(region),
      products_(offsets.cols() >= kPhotosAProduct * QuadraticFeatures(offsets.rows(), true).size()) {
  assert(offsets.cols() >= least_photos(offsets.rows(), scores.rows()));
  const Eigen::MatrixXd design = features().design(offsets);
  const LeastSquares mean(design, scores);
  degrees_ = mean.degrees;
  // A score that never errs would be believed without end.
  const Eigen::VectorXd spread = scores.rowwise().squaredNorm() / static_cast<double>(scores.cols());
  const Eigen::LLT<Eigen::MatrixXd> errors(
      mean.covariance() + Eigen::MatrixXd((1e-10 * spread.array() + 1e-20).matrix().asDiagonal()));
  coefficients_ = errors.matrixL().solve(mean.coefficients);
  seen_ = errors.matrixL().solve(observed);
  learn_variances(design, offsets, errors.matrixL().solve(scores), errors.matrixL().solve(mean.left_out()));
}

/// Mean and variance of each independent score, in turn, as both depend on each other; of few photos one
/// variance for all.
void SyntheticLikelihood::learn_variances(const Eigen::MatrixXd& design, const Eigen::MatrixXd& offsets,
                                          const Eigen::MatrixXd& scores, Eigen::MatrixXd errors) {
  constexpr int kTurns = 2;
  const Eigen::Index size = scores.rows();
  const double unknown_mean = static_cast<double>(design.cols()) / static_cast<double>(design.rows());
  log_variances_ = Eigen::VectorXd::Constant(size, std::log1p(unknown_mean));
  growth_ = Eigen::MatrixXd::Zero(size, offsets.rows());
  if (offsets.cols() < kPhotosAGrowth * (1 + offsets.rows())) return;
  for (Eigen::Index i = 0; i < size; ++i)
    for (int turn = 0; turn < kTurns; ++turn) {
      const Eigen::VectorXd variance = fit_log_variance(errors.row(i), offsets);
      const Eigen::VectorXd slopes = variance.tail(offsets.rows());
      const Eigen::VectorXd precisions = (-0.5 * (offsets.transpose() * slopes).array()).exp();
      const LeastSquares weighted(precisions.asDiagonal() * design, scores.row(i) * precisions.asDiagonal());
      errors.row(i) = weighted.left_out() * precisions.cwiseInverse().asDiagonal();
      coefficients_.row(i) = weighted.coefficients;
      log_variances_[i] = variance[0];
      growth_.row(i) = slopes;
    }
}

SyntheticLikelihood SyntheticLikelihood::widened(double times) const {
  SyntheticLikelihood wider = *this;
  wider.log_variances_.array() += std::log(times);
  return wider;
}

Evaluation SyntheticLikelihood::evaluate(const Eigen::VectorXd& coordinates) const {
  const Eigen::VectorXd v = region_.offset(coordinates);
  const double radius = trusted_radius(v.size()), distance = v.norm();
  const Eigen::VectorXd log_variances = log_variances_ + growth_ * v;
  const Eigen::VectorXd error = coefficients_ * features().values(v) - seen_;
  const Eigen::VectorXd weighted = error.array() * (-log_variances.array()).exp();
  const double squared = weighted.dot(error);
  // Sellentin & Heavens 2016, equation 10, with n - 1 the degrees of freedom.
  double misfit = 0.5 * log_variances.sum() + 0.5 * (degrees_ + 1) * std::log1p(squared / degrees_);
  const Eigen::VectorXd by_error = features().slopes(v).transpose() * (coefficients_.transpose() * weighted);
  const Eigen::VectorXd by_variance = growth_.transpose() * weighted.cwiseProduct(error);
  Eigen::VectorXd slope = 0.5 * growth_.colwise().sum().transpose() +
                          (degrees_ + 1) / (degrees_ + squared) * (by_error - 0.5 * by_variance);
  if (distance > radius) {
    misfit += 0.5 * (distance - radius) * (distance - radius);
    slope += (distance - radius) / distance * v;
  }
  return {-misfit, -region_.factor.triangularView<Eigen::Lower>().transpose().solve(slope)};
}

bool SyntheticLikelihood::is_of(Eigen::Index coordinates) const {
  const Eigen::Index scores = seen_.size();
  const bool sized = region_.centre.size() == coordinates && region_.factor.rows() == coordinates &&
                     region_.factor.cols() == coordinates && coefficients_.rows() == scores &&
                     coefficients_.cols() == features().size() && log_variances_.size() == scores &&
                     growth_.rows() == scores && growth_.cols() == coordinates;
  return sized && region_.centre.allFinite() && region_.factor.allFinite() &&
         (region_.factor.diagonal().array() > 0).all() && degrees_ > 0 && coefficients_.allFinite() &&
         seen_.allFinite() && log_variances_.allFinite() && growth_.allFinite();
}

void SyntheticLikelihood::serialise(Archive& archive) {
  archive(region_.centre, region_.factor, products_, degrees_, coefficients_, seen_, log_variances_, growth_);
}

}  // namespace patina
