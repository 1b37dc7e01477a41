#include "engine/posterior/local_regression.h"

#include <algorithm>
#include <cmath>

#include "engine/posterior/ridge.h"

namespace patina {
namespace {

double effective_number(const Eigen::ArrayXd& weights) {
  return weights.sum() * weights.sum() / weights.square().sum();
}

/// The smallest share of a place's sd in the region that a spread of predictions is taken for: so little is
/// no prediction.
constexpr double kNothing = 0.1;

/// The mean square of one target's errors, of photos of which about the same is predicted as of the one
/// observed. Of 50 photos of bump, 20 of flake, 50 of leather and 50 of wood, the log density of the truth
/// grew by 0.20, 0.11, 0.16 and 0.01 on average.
/// @param squares  of errors, times weights   @param away  predicted less what is for the observed
double nearby_mean_square(const Eigen::ArrayXd& squares, const Eigen::ArrayXd& away,
                          const Eigen::ArrayXd& weights) {
  constexpr double kWidth = 0.6, kLeastShare = 0.1;
  const double centre = (weights * away).sum() / weights.sum();
  const double spread = std::sqrt((weights * (away - centre).square()).sum() / weights.sum()) + kNothing;
  const Eigen::ArrayXd distances = (away / spread).square();
  for (double width = kWidth;; width *= 1.3) {
    const Eigen::ArrayXd near = (-0.5 * (distances - distances.minCoeff()) / (width * width)).exp();
    const Eigen::ArrayXd together = weights * near;
    if (!(effective_number(together) < kLeastShare * static_cast<double>(away.size())))
      return (squares * near).sum() / together.sum();
  }
}

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
  LocalRegression found{middle, Eigen::VectorXd(offsets.rows()), offsets, offsets};
  for (Eigen::Index i = 0; i < offsets.rows(); ++i) {
    const Eigen::VectorXd target = (offsets.row(i).transpose().array() - middle[i]) * roots.array();
    const RidgeFit fit = fit_ridge(target, spectrum, weights / photos);
    const Eigen::VectorXd slopes = scales.cwiseProduct(inputs * fit.dual);
    found.mean[i] += slopes.dot(observed - centre);
    found.predicted.row(i) = (slopes.transpose() * away).array() + middle[i];
    found.errors.row(i) = fit.errors.transpose();
    const Eigen::ArrayXd values = spectrum.values.array().max(1e-9 * spectrum.values.maxCoeff());
    const double leverage = 1 / photos + (along.square() / (values * (values + fit.damping))).sum();
    const double square = nearby_mean_square(
        fit.errors.array().square(), found.predicted.row(i).transpose().array() - found.mean[i], weights);
    // Errors have in them what is unknown of the mean for a usual photo.
    found.sd[i] = std::sqrt(std::max(square, 1e-20) * (1 + leverage) / (1 + fit.usual_leverage));
  }
  return found;
}

/// More for photos whose places are predicted to be near that of the one observed, about which regressions
/// are straight and errors alike (local regression, Beaumont et al. 2002).
Eigen::VectorXd local_weights(const LocalRegression& of) {
  constexpr double kWidth = 0.7;  // in the spread of what is predicted
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
    if (!(effective_number(weights) < kLeastShare * photos)) return weights * (photos / weights.sum());
  }
}

}  // namespace

LocalRegression local_regression(const Eigen::MatrixXd& offsets, const Eigen::MatrixXd& scores,
                                 const Eigen::VectorXd& observed) {
  const LocalRegression everywhere = regress(offsets, scores, observed, Eigen::VectorXd::Ones(scores.cols()));
  return regress(offsets, scores, observed, local_weights(everywhere));
}

}  // namespace patina
