#include "engine/posterior/synthetic_likelihood.h"

#include <Eigen/Cholesky>

#include <cassert>
#include <cmath>

#include "engine/posterior/least_squares.h"
#include "engine/sampling/archive.h"

namespace patina {
namespace {

constexpr Eigen::Index kPhotosAProduct = 3, kPhotosASquare = 2;

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
  const double unknown_mean = static_cast<double>(design.cols()) / static_cast<double>(design.rows());
  const Eigen::MatrixXd sigma = (1 + unknown_mean) * mean.covariance();
  // A score that never errs would be believed without end.
  const Eigen::VectorXd spread = scores.rowwise().squaredNorm() / static_cast<double>(scores.cols());
  const Eigen::LLT<Eigen::MatrixXd> errors(
      sigma + Eigen::MatrixXd((1e-10 * spread.array() + 1e-20).matrix().asDiagonal()));
  degrees_ = mean.degrees;
  coefficients_ = errors.matrixL().solve(mean.coefficients);
  seen_ = errors.matrixL().solve(observed);
}

SyntheticLikelihood SyntheticLikelihood::widened(double times) const {
  SyntheticLikelihood wider = *this;
  wider.coefficients_ /= std::sqrt(times);
  wider.seen_ /= std::sqrt(times);
  return wider;
}

Evaluation SyntheticLikelihood::evaluate(const Eigen::VectorXd& coordinates) const {
  const Eigen::VectorXd v = region_.offset(coordinates);
  const Eigen::VectorXd error = coefficients_ * features().values(v) - seen_;
  const double squared = error.squaredNorm(), radius = trusted_radius(v.size()), distance = v.norm();
  // Sellentin & Heavens 2016, equation 10, with n - 1 the degrees of freedom.
  double misfit = 0.5 * (degrees_ + 1) * std::log1p(squared / degrees_);
  Eigen::VectorXd slope = (degrees_ + 1) / (degrees_ + squared) *
                          (features().slopes(v).transpose() * (coefficients_.transpose() * error));
  if (distance > radius) {
    misfit += 0.5 * (distance - radius) * (distance - radius);
    slope += (distance - radius) / distance * v;
  }
  return {-misfit, -region_.factor.triangularView<Eigen::Lower>().transpose().solve(slope)};
}

bool SyntheticLikelihood::is_of(Eigen::Index coordinates) const {
  return region_.centre.size() == coordinates && region_.factor.rows() == coordinates &&
         region_.factor.cols() == coordinates && region_.centre.allFinite() && region_.factor.allFinite() &&
         (region_.factor.diagonal().array() > 0).all() && degrees_ > 0 &&
         coefficients_.cols() == features().size() && coefficients_.rows() == seen_.size() &&
         coefficients_.allFinite() && seen_.allFinite();
}

void SyntheticLikelihood::serialise(Archive& archive) {
  archive(region_.centre, region_.factor, products_, degrees_, coefficients_, seen_);
}

}  // namespace patina
