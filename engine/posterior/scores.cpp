#include "engine/posterior/scores.h"

#include <utility>

#include "engine/posterior/least_squares.h"
#include "engine/posterior/quadratic_features.h"
#include "engine/posterior/ridge.h"

namespace patina {

Scores::Scores(const Eigen::MatrixXd& places, const Eigen::MatrixXd& summaries, Compression compression)
    : compression_(std::move(compression)),
      weights_(places.rows(), summaries.rows()),
      left_out_(places.rows(), places.cols()) {
  Eigen::MatrixXd scaled = compression_(summaries);
  const Eigen::VectorXd mean = scaled.rowwise().mean(), mean_place = places.rowwise().mean();
  scaled.colwise() -= mean;
  const Eigen::VectorXd variances = scaled.rowwise().squaredNorm() / static_cast<double>(scaled.cols());
  // An entry that never changes says nothing.
  const Eigen::VectorXd precisions =
      (variances.array() > 1e-20).select(variances.array().max(1e-20).rsqrt(), 0.0);
  scaled = precisions.asDiagonal() * scaled;
  const Spectrum spectrum(scaled);
  const auto photos = static_cast<double>(scaled.cols());
  const Eigen::VectorXd mean_leverages = Eigen::VectorXd::Constant(scaled.cols(), 1 / photos);
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    const Eigen::VectorXd target = places.row(i).transpose().array() - mean_place[i];
    const RidgeFit best = fit_ridge(target, spectrum, mean_leverages);
    weights_.row(i) = (precisions.asDiagonal() * (scaled * best.dual)).transpose();
    left_out_.row(i) = places.row(i) - best.errors.transpose();
  }
  constants_ = mean_place - weights_ * mean;
  straighten(places);
}

/// Of linear scores in units of their spread; far beyond it a square would say nonsense.
Eigen::MatrixXd Scores::design(const Eigen::MatrixXd& linear) const {
  constexpr double kFurthest = 3.5;
  const Eigen::MatrixXd scaled = scales_.cwiseInverse().asDiagonal() * (linear.colwise() - centres_);
  return QuadraticFeatures(linear.rows(), products_).design(scaled.cwiseMax(-kFurthest).cwiseMin(kFurthest));
}

void Scores::straighten(const Eigen::MatrixXd& places) {
  constexpr Eigen::Index kPhotosAFeature = 6;
  const Eigen::Index count = places.cols();
  centres_ = left_out_.rowwise().mean();
  scales_ = (left_out_.colwise() - centres_).rowwise().squaredNorm() / static_cast<double>(count);
  scales_ = scales_.cwiseMax(1e-20).cwiseSqrt();
  products_ = count >= kPhotosAFeature * QuadraticFeatures(places.rows(), true).size();
  const LeastSquares quadratic(design(left_out_), places);
  bent_ = quadratic.coefficients;
  left_out_ = places - quadratic.left_out();
}

Eigen::MatrixXd Scores::operator()(const Eigen::MatrixXd& summaries) const {
  return bent_ * design((weights_ * compression_(summaries)).colwise() + constants_).transpose();
}

}  // namespace patina
