#pragma once

#include <Eigen/Core>

#include <limits>

#include "engine/posterior/region.h"
#include "engine/sampling/log_density.h"

namespace patina {

class Archive;

/// The likelihood of a photo that photos simulated in a region make by what their scores say of their places
/// (regression adjustment: Beaumont et al. 2002, Fearnhead & Prangle 2012). Places v ~ N(0, I) of the region
/// are regressed on scores, see LocalRegression:
///   v | scores ~ N(m, S): m linear in the scores; S the covariance of the residuals, each as it would be,
///   had the other photos alone been regressed, wider by what is unknown of m.
/// The likelihood is N(m, S) over N(0, I): exp(-Q / 2), Q = (v - p)^T (S^-1 - I) (v - p), p = (I - S)^-1 m, a
/// place that is seen with errors, and the posterior under any prior follows. Irregularities are averaged
/// over, so that they count once, the photo's; jagged coordinates are smooth; and what scores do not tell
/// cannot seem known, for S is judged by photos that the regression has not seen. The scores must have been
/// chosen by other photos: of far more entries than photos some seem to know the coordinates by chance, in
/// the photos that they were chosen by. It is to be trusted where there were simulations: beyond sqrt(m) + 3
/// of their standard deviations it falls as a normal density does, so that no far-away point looks good for
/// what was never simulated.
///
/// The ridge of light times albedo is bent, and as wide as its albedo is high: truths' light is on average at
/// 0.35 to 0.45 of its draws. Regressed in logarithms of light and colours, where it is straight, light was
/// at 0.45 to 0.51 and 90 % intervals of flake's albedos held 89 to 91 % of 100 truths (86 to 87 before), but
/// plaster's 75 %: near 1 a logarithm rests where its coordinate goes on.
class RegressedLikelihood {
 public:
  RegressedLikelihood() = default;

  /// @param offsets   v of the simulated photos, coordinates x n   @param scores  theirs, scores x n
  /// @param observed  scores of the photo
  RegressedLikelihood(const Region& region, const Eigen::MatrixXd& offsets, const Eigen::MatrixXd& scores,
                      const Eigen::VectorXd& observed);

  /// The same with errors of so many times the variance.
  RegressedLikelihood widened(double times) const;

  /// The same with less of what is hardly told: the precision p that it has along an axis, in which the
  /// prior's is 1, is taken for p * p / (1 + p). What is told little is told unevenly: how far light and
  /// albedo can be told apart, say, differs along their ridge, and the average is too much where albedo is
  /// high.
  RegressedLikelihood doubted() const;

  /// The same where S is known by few photos, or some err more than others in all directions at once:
  /// (1 + Q / degrees)^(-(degrees + k) / 2) in place of exp(-Q / 2), k the number of directions that are told
  /// (a t likelihood, as Sellentin & Heavens 2016 have it for covariances that are estimated).
  RegressedLikelihood heavy_tailed(double degrees_of_freedom) const;

  /// Log likelihood and its gradient.
  Evaluation evaluate(const Eigen::VectorXd& coordinates) const;

  /// Whether what was read from an archive is a likelihood of so many coordinates.
  bool is_of(Eigen::Index coordinates) const;

  void serialise(Archive& archive);

 private:
  Region region_;
  Eigen::MatrixXd precision_;  ///< S^-1 - I, of the directions that are told
  Eigen::VectorXd place_;      ///< p, likewise
  Eigen::Index told_ = 0;      ///< their number
  double degrees_ = std::numeric_limits<double>::infinity();
};

}  // namespace patina
