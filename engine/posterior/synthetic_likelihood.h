#pragma once

#include <Eigen/Core>

#include "engine/posterior/quadratic_features.h"
#include "engine/posterior/region.h"
#include "engine/sampling/log_density.h"

namespace patina {

class Archive;

/// The likelihood of a photo's scores that photos simulated in a region make (Wood 2010; Price et al. 2018).
///   mean      of the scores, quadratic in the coordinates, by least squares: irregularities are averaged
///             over, so that they count once, the photo's, and jagged coordinates are smooth.
///   errors    covariance of the residuals, with what is unknown of the mean and what the regression misses;
///             along each of the directions in which they are independent their variance changes with the
///             coordinates, exponentially. For so few simulations a t distribution (Sellentin & Heavens
///             2016).
/// The scores must have been chosen by other photos: of far more entries than photos some seem to know the
/// coordinates by chance, in the photos that they were chosen by.
/// It is to be trusted where there were simulations: beyond sqrt(m) + 3 of their standard deviations it falls
/// as a normal density does, so that no far-away point looks good for what was never simulated.
class SyntheticLikelihood {
 public:
  SyntheticLikelihood() = default;

  /// @param offsets   v of the simulated photos, coordinates x n   @param scores  theirs, scores x n
  /// @param observed  scores of the photo
  SyntheticLikelihood(const Region& region, const Eigen::MatrixXd& offsets, const Eigen::MatrixXd& scores,
                      const Eigen::VectorXd& observed);

  /// The least photos that it can be made of.
  static Eigen::Index least_photos(Eigen::Index coordinates, Eigen::Index scores);

  /// The same with errors of so many times the variance.
  SyntheticLikelihood widened(double times) const;

  /// Log likelihood and its gradient.
  Evaluation evaluate(const Eigen::VectorXd& coordinates) const;

  /// Whether what was read from an archive is a likelihood of so many coordinates.
  bool is_of(Eigen::Index coordinates) const;

  void serialise(Archive& archive);

 private:
  void learn_variances(const Eigen::MatrixXd& design, const Eigen::MatrixXd& offsets,
                       const Eigen::MatrixXd& scores, Eigen::MatrixXd errors);
  QuadraticFeatures features() const { return {region_.centre.size(), products_}; }

  Region region_;
  bool products_ = false;
  double degrees_ = 1;  ///< of freedom of the errors
  // Of the independent errors:
  Eigen::MatrixXd coefficients_;   ///< their mean, x features
  Eigen::VectorXd seen_;           ///< the photo's
  Eigen::VectorXd log_variances_;  ///< at the centre
  Eigen::MatrixXd growth_;         ///< of those, x coordinates
};

}  // namespace patina
