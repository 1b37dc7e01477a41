#include "engine/posterior/local_regression.h"

#include <cmath>

#include "engine/posterior/ridge.h"

namespace patina {
namespace {

/// @param weights  of the photos, 1 on average
LocalRegression regress(const Eigen::MatrixXd& offsets, const Eigen::MatrixXd& scores,
                        const Eigen::VectorXd& observed, const Eigen::VectorXd& weights) {
  const auto photos = static_cast<double>(scores.cols());
  const Eigen::VectorXd centre = scores * weights / photos, middle = offsets * weights / photos;
  const Eigen::MatrixXd away = scores.colwise() - centre;
  const Eigen::VectorXd scales =
      (away.cwiseAbs2() * weights / photos).cwiseMax(1e-20).cwiseSqrt().cwiseInverse();
  const Eigen::VectorXd roots = weights.cwiseSqrt();
  const Eigen::MatrixXd inputs = scales.asDiagonal() * away * roots.asDiagonal();
  const Spectrum spectrum(inputs);
  const Eigen::VectorXd asked = scales.cwiseProduct(observed - centre);
  const Eigen::ArrayXd along = (spectrum.vectors.transpose() * (inputs.transpose() * asked)).array();
  LocalRegression found{middle, offsets, offsets, Eigen::VectorXd(offsets.rows())};
  for (Eigen::Index i = 0; i < offsets.rows(); ++i) {
    const Eigen::VectorXd target = (offsets.row(i).transpose().array() - middle[i]) * roots.array();
    const RidgeFit fit = fit_ridge(target, spectrum, weights / photos);
    const Eigen::VectorXd slopes = scales.cwiseProduct(inputs * fit.dual);
    found.mean[i] += slopes.dot(observed - centre);
    found.predicted.row(i) = (slopes.transpose() * away).array() + middle[i];
    found.errors.row(i) = fit.errors.transpose();
    const Eigen::ArrayXd values = spectrum.values.array().max(1e-9 * spectrum.values.maxCoeff());
    const double leverage = 1 / photos + (along.square() / (values * (values + fit.damping))).sum();
    found.sd_factors[i] = std::sqrt((1 + leverage) / (1 + fit.usual_leverage));
  }
  return found;
}

/// More for photos whose places are predicted to be near that of the one observed, about which regressions
/// are straight and errors alike (local regression, Beaumont et al. 2002).
Eigen::VectorXd local_weights(const LocalRegression& of) {
  constexpr double kWidth = 0.7;    // in the spread of what is predicted
  constexpr double kNothing = 0.1;  // of a place's sd in the region: so little is no prediction
  constexpr double kLeastShare = 0.5;
  const auto photos = static_cast<double>(of.predicted.cols());
  const Eigen::MatrixXd about_mean = of.predicted.colwise() - of.predicted.rowwise().mean();
  const Eigen::VectorXd spreads =
      (about_mean.rowwise().squaredNorm() / photos).cwiseSqrt().array() + kNothing;
  const Eigen::MatrixXd away = spreads.cwiseInverse().asDiagonal() * (of.predicted.colwise() - of.mean);
  const Eigen::ArrayXd distances = away.cwiseAbs2().colwise().mean().transpose();
  // A photo that is like none is not left with its nearest few.
  for (double width = kWidth;; width *= 1.5) {
    const Eigen::ArrayXd weights = (-0.5 * (distances - distances.minCoeff()) / (width * width)).exp();
    const double effective = weights.sum() * weights.sum() / weights.square().sum();
    if (!(effective < kLeastShare * photos)) return weights * (photos / weights.sum());
  }
}

}  // namespace

LocalRegression local_regression(const Eigen::MatrixXd& offsets, const Eigen::MatrixXd& scores,
                                 const Eigen::VectorXd& observed) {
  const LocalRegression everywhere = regress(offsets, scores, observed, Eigen::VectorXd::Ones(scores.cols()));
  return regress(offsets, scores, observed, local_weights(everywhere));
}

}  // namespace patina
