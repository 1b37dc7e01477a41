#include "engine/posterior/synthetic_likelihood.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace patina {
namespace {

constexpr double kNoInformation = 1e-9;  // of a direction, relative to the best known one
constexpr Eigen::Index kMostComponents = 10, kPhotosAComponent = 10, kPhotosAProduct = 3;

Eigen::Index half_of(const SimulatedPhotos& simulated) { return simulated.offsets.cols() / 2; }

/// Features of all simulated photos, n x features.
Eigen::MatrixXd design(const Eigen::MatrixXd& offsets, const QuadraticFeatures& features) {
  Eigen::MatrixXd design(offsets.cols(), features.size());
  for (Eigen::Index i = 0; i < offsets.cols(); ++i) design.row(i) = features.values(offsets.col(i));
  return design;
}

QuadraticFeatures features_for(const Eigen::MatrixXd& offsets) {
  const QuadraticFeatures all(offsets.rows(), true);
  if (offsets.cols() >= kPhotosAProduct * all.size()) return all;
  return {offsets.rows(), false};
}

/// Least squares of values (outputs x n) on the rows of a design.
struct Regression {
  Eigen::MatrixXd coefficients;  ///< outputs x features
  Eigen::MatrixXd residuals;     ///< outputs x n
  Eigen::VectorXd leverages;     ///< n
  double degrees;                ///< of freedom left

  Regression(const Eigen::MatrixXd& design, const Eigen::MatrixXd& values)
      : degrees(static_cast<double>(design.rows() - design.cols())) {
    assert(degrees > 2);
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(design);
    const Eigen::MatrixXd basis = qr.householderQ() * Eigen::MatrixXd::Identity(design.rows(), design.cols());
    coefficients = qr.solve(values.transpose()).transpose();
    residuals = values - coefficients * design.transpose();
    leverages = basis.rowwise().squaredNorm();
  }

  Eigen::VectorXd variances() const { return residuals.rowwise().squaredNorm() / degrees; }
  Eigen::MatrixXd covariance() const { return residuals * residuals.transpose() / degrees; }

  /// Each as it would be, had the others alone been regressed.
  Eigen::MatrixXd left_out() const {
    return residuals * (1 - leverages.array()).max(1e-3).inverse().matrix().asDiagonal();
  }
};

/// J^T C^-1 in the directions that have information, each scaled to one unit of it.
Eigen::MatrixXd score_weights(const Eigen::MatrixXd& slopes, const Eigen::VectorXd& variances) {
  const Eigen::MatrixXd weighted = slopes.transpose() * variances.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(weighted * slopes);
  const Eigen::VectorXd& information = spectrum.eigenvalues();
  const Eigen::Index kept = (information.array() > kNoInformation * information.maxCoeff()).count();
  return information.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal() *
         spectrum.eigenvectors().rightCols(kept).transpose() * weighted;
}

/// The leading principal components of residuals, entries in units of their sds.
Eigen::MatrixXd component_weights(const Eigen::MatrixXd& residuals, const Eigen::VectorXd& variances,
                                  Eigen::Index count) {
  const Eigen::VectorXd precisions = variances.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = precisions.asDiagonal() * residuals;
  // Left singular vectors, from whichever square is the smaller.
  using Spectrum = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;
  const Eigen::MatrixXd directions =
      scaled.rows() < scaled.cols()
          ? Eigen::MatrixXd(Spectrum(scaled * scaled.transpose()).eigenvectors().rightCols(count))
          : Eigen::MatrixXd(scaled * Spectrum(scaled.transpose() * scaled).eigenvectors().rightCols(count));
  return directions.colwise().normalized().transpose() * precisions.asDiagonal();
}

Eigen::MatrixXd stacked(const Eigen::MatrixXd& above, const Eigen::MatrixXd& below) {
  Eigen::MatrixXd both(above.rows() + below.rows(), above.cols());
  both << above, below;
  return both;
}

/// Scores and components, (k + r) x p.
Eigen::MatrixXd weights_of(const Regression& entries, const Eigen::VectorXd& variances,
                           Eigen::Index coordinates) {
  const Eigen::MatrixXd scores = score_weights(entries.coefficients.middleCols(1, coordinates), variances);
  const Eigen::Index count = std::min({kMostComponents, entries.residuals.cols() / kPhotosAComponent,
                                       entries.residuals.rows() - scores.rows()});
  return stacked(scores, component_weights(entries.residuals, variances, count));
}

double trusted_radius(Eigen::Index dimension) { return std::sqrt(static_cast<double>(dimension)) + 3; }

}  // namespace

SyntheticLikelihood::SyntheticLikelihood(const SimulatedPhotos& simulated, const Eigen::VectorXd& photo,
                                         double floor)
    : centre_(simulated.centre),
      factor_(simulated.factor),
      informed_(simulated.informed),
      features_(features_for(simulated.offsets.rightCols(half_of(simulated)))) {
  const Eigen::Index half = half_of(simulated), coordinates = simulated.offsets.rows();
  const Eigen::MatrixXd first = simulated.offsets.leftCols(half), second = simulated.offsets.rightCols(half);
  const Regression entries(design(first, {coordinates, false}), simulated.summaries.leftCols(half));
  const Eigen::VectorXd variances = entries.variances().array() + floor * floor;
  const Eigen::MatrixXd weights = weights_of(entries, variances, coordinates);
  fit_ = photo_fit(photo - entries.coefficients.col(0), entries.left_out(), variances);

  const Eigen::MatrixXd design = patina::design(second, features_);
  const Regression scores(design, weights * simulated.summaries.rightCols(half));
  const double mean_error = static_cast<double>(features_.size()) / static_cast<double>(design.rows());
  Eigen::MatrixXd sigma = fit_.widening * (1 + mean_error) * scores.covariance();
  sigma += floor * floor * weights * weights.transpose();  // its share, which exact renders would not show
  const Eigen::LLT<Eigen::MatrixXd> errors(sigma);
  degrees_ = scores.degrees;
  coefficients_ = errors.matrixL().solve(scores.coefficients);
  seen_ = errors.matrixL().solve(weights * photo);
}

Evaluation SyntheticLikelihood::evaluate(const Eigen::VectorXd& coordinates) const {
  const Eigen::VectorXd v =
      factor_.triangularView<Eigen::Lower>().solve((coordinates - centre_)(informed_).eval());
  const Eigen::VectorXd error = coefficients_ * features_.values(v) - seen_;
  const double squared = error.squaredNorm(), radius = trusted_radius(v.size()), distance = v.norm();
  // Sellentin & Heavens 2016, equation 10, with n - 1 the degrees of freedom.
  double misfit = 0.5 * (degrees_ + 1) * std::log1p(squared / degrees_);
  Eigen::VectorXd slope = (degrees_ + 1) / (degrees_ + squared) *
                          (features_.slopes(v).transpose() * (coefficients_.transpose() * error));
  if (distance > radius) {
    misfit += 0.5 * (distance - radius) * (distance - radius);
    slope += (distance - radius) / distance * v;
  }
  Evaluation evaluation{-misfit, Eigen::VectorXd::Zero(coordinates.size())};
  evaluation.gradient(informed_) = -factor_.transpose().triangularView<Eigen::Upper>().solve(slope);
  return evaluation;
}

PhotoFit photo_fit(const Eigen::VectorXd& photo, const Eigen::MatrixXd& residuals,
                   const Eigen::VectorXd& variances) {
  const Eigen::VectorXd precisions = variances.cwiseInverse();
  const Eigen::VectorXd distances = (precisions.transpose() * residuals.cwiseAbs2()).transpose();
  std::vector<double> simulated(distances.begin(), distances.end());
  std::ranges::sort(simulated);
  const double observed = precisions.dot(photo.cwiseAbs2());
  const auto n = static_cast<double>(simulated.size());
  const auto beyond = simulated.end() - std::ranges::lower_bound(simulated, observed);
  const double usual = simulated[static_cast<std::size_t>(std::ceil(0.95 * n)) - 1];
  return {std::sqrt(observed / distances.mean()), (1 + static_cast<double>(beyond)) / (n + 1),
          std::max(1.0, observed / usual)};
}

}  // namespace patina
