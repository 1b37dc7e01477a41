#include "engine/posterior/scores.h"

#include <utility>

#include "engine/posterior/least_squares.h"
#include "engine/posterior/quadratic_features.h"
#include "engine/posterior/ridge.h"

namespace patina {

namespace {

/// 1 / sd of each entry. One that never changes says nothing.
Eigen::VectorXd precisions_of(const Eigen::MatrixXd& entries) {
  const Eigen::VectorXd mean = entries.rowwise().mean();
  const Eigen::VectorXd variances =
      (entries.colwise() - mean).rowwise().squaredNorm() / static_cast<double>(entries.cols());
  return (variances.array() > 1e-20).select(variances.array().max(1e-20).rsqrt(), 0.0);
}

}  // namespace

Scores::Scores(const Eigen::MatrixXd& places, const Eigen::MatrixXd& summaries, Compression compression)
    : compression_(std::move(compression)) {
  const Eigen::MatrixXd entries = compression_(summaries);
  weigh(places, entries, precisions_of(entries), 0);
  straighten(places);
}

Scores::Scores(const Eigen::MatrixXd& places, const Eigen::MatrixXd& summaries, const KnownErrors& errors) {
  weigh(places, summaries - errors.drawn, errors.sds.cwiseInverse(), 1);
  left_out_ += weights_ * errors.drawn;
  straighten(places);
}

/// The linear step.
/// @param precisions  1 / unit of each entry   @param noise  its variance in these units, see fit_ridge()
void Scores::weigh(const Eigen::MatrixXd& places, const Eigen::MatrixXd& entries,
                   const Eigen::VectorXd& precisions, double noise) {
  const Eigen::VectorXd mean = entries.rowwise().mean(), mean_place = places.rowwise().mean();
  const Eigen::MatrixXd scaled = precisions.asDiagonal() * (entries.colwise() - mean);
  const Spectrum spectrum(scaled);
  weights_.resize(places.rows(), entries.rows());
  left_out_.resize(places.rows(), places.cols());
  const auto photos = static_cast<double>(scaled.cols());
  const Eigen::VectorXd mean_leverages = Eigen::VectorXd::Constant(scaled.cols(), 1 / photos);
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    const Eigen::VectorXd target = places.row(i).transpose().array() - mean_place[i];
    const RidgeFit best = fit_ridge(target, spectrum, mean_leverages, noise);
    weights_.row(i) = (precisions.asDiagonal() * (scaled * best.dual)).transpose();
    left_out_.row(i) = places.row(i) - best.errors.transpose();
  }
  constants_ = mean_place - weights_ * mean;
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
