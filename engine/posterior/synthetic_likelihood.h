#pragma once

#include <Eigen/Core>

#include <vector>

#include "engine/posterior/quadratic_features.h"
#include "engine/sampling/log_density.h"

namespace patina {

/// Photos simulated around a centre, each with irregularities of its own.
struct SimulatedPhotos {
  Eigen::VectorXd centre;              ///< of the coordinates, prior N(0, I)
  Eigen::MatrixXd factor;              ///< L, of the informed ones: x = centre + L v
  std::vector<Eigen::Index> informed;  ///< coordinates that are no places
  Eigen::MatrixXd offsets;             ///< v, N(0, I): informed x n
  Eigen::MatrixXd summaries;           ///< p x n
};

/// How a photo's summary compares with those of simulated photos.
struct PhotoFit {
  double distance = 1;  ///< root of the photo's chi-square over the simulated photos' mean
  double p = 1;         ///< share of simulated photos that are as far away, the photo counted in
  double widening = 1;  ///< of the errors' covariance: what is beyond 95 % of the simulated photos
};

/// The likelihood of a photo's summary that simulations around a centre make (Wood 2010; Price et al. 2018).
///   scores    t = J^T C^-1 s (Alsing & Wandelt 2018): J the mean slopes and C the variances of the
///   residuals,
///             no covariances: a poorer C loses information, but is as true, since the scores' own covariance
///             is estimated. To them come leading principal components of the residuals, which tell how the
///             irregularities make scores err together.
///   mean      of the scores, quadratic in the coordinates, by least squares: irregularities are averaged
///             over, so that they count once, the photo's, and jagged coordinates are smooth.
///   errors    covariance of the residuals, with what is unknown of the mean and what the regression misses;
///             for so few simulations a t distribution (Sellentin & Heavens 2016).
/// One half of the photos says what the scores are, the other what they are worth: of far more entries than
/// photos some seem to know the coordinates by chance, in the photos that they were chosen by.
/// It is to be trusted where there were simulations: beyond sqrt(m) + 3 of their standard deviations it falls
/// as a normal density does, so that no far-away point looks good for what was never simulated.
class SyntheticLikelihood {
 public:
  /// @param floor  least error of any entry of the summary, what its computation is good for
  SyntheticLikelihood(const SimulatedPhotos& simulated, const Eigen::VectorXd& photo, double floor);

  /// Log likelihood and its gradient along all coordinates, zero along places.
  Evaluation evaluate(const Eigen::VectorXd& coordinates) const;

  /// Of the photo with those simulated, all compared with their mean at the centre.
  const PhotoFit& fit() const { return fit_; }

 private:
  Eigen::VectorXd centre_;
  Eigen::MatrixXd factor_;
  std::vector<Eigen::Index> informed_;
  QuadraticFeatures features_;
  double degrees_;                ///< of freedom of the errors
  Eigen::MatrixXd coefficients_;  ///< scores x features, scores in units of their errors
  Eigen::VectorXd seen_;          ///< the photo's scores
  PhotoFit fit_;
};

/// @param photo  residual   @param residuals  p x n, each as if left out   @param variances  of the entries
PhotoFit photo_fit(const Eigen::VectorXd& photo, const Eigen::MatrixXd& residuals,
                   const Eigen::VectorXd& variances);

}  // namespace patina
