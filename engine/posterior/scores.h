#pragma once

#include <Eigen/Core>

#include "engine/posterior/compression.h"

namespace patina {

/// Independent errors of known sds in summaries, beside all that made them.
struct KnownErrors {
  Eigen::VectorXd sds;
  Eigen::MatrixXd drawn;  ///< entries x n: what is in the summaries
};

/// What a summary says about where its photo was simulated: the mean of that place given the summary
/// (Fearnhead & Prangle 2012), in two steps. The first is a ridge regression on the entries. To first order
/// its results are the scores J^T C^-1 s of a normal model (Alsing & Wandelt 2018) with the covariance C
/// shrunk to a diagonal; how far, the photos decide that are left out. A poorer C loses information, but is
/// as true where the scores' own errors are estimated. The second is a quadratic regression on those, which
/// makes them about as straight in the place as they can be.
class Scores {
 public:
  /// @param places  targets x n   @param summaries  entries x n   @param compression  that comes first
  Scores(const Eigen::MatrixXd& places, const Eigen::MatrixXd& summaries, Compression compression = {});

  /// Of summaries with known errors, in whose units entries are regressed, and on average over which: were
  /// they left to be learnt from the few that were drawn, with entries far more than photos, most of what the
  /// photos say would be lost in them.
  Scores(const Eigen::MatrixXd& places, const Eigen::MatrixXd& summaries, const KnownErrors& errors);

  Eigen::MatrixXd operator()(const Eigen::MatrixXd& summaries) const;

  /// The scores of the photos that they were learnt from, each by the others.
  const Eigen::MatrixXd& left_out() const { return left_out_; }

 private:
  void weigh(const Eigen::MatrixXd& places, const Eigen::MatrixXd& entries, const Eigen::VectorXd& precisions,
             double noise);
  Eigen::MatrixXd design(const Eigen::MatrixXd& linear) const;
  void straighten(const Eigen::MatrixXd& places);

  Compression compression_;
  Eigen::MatrixXd weights_;  ///< targets x entries, of the linear step
  Eigen::VectorXd constants_;
  Eigen::VectorXd centres_, scales_;  ///< of the linear scores
  bool products_ = false;             ///< see QuadraticFeatures
  Eigen::MatrixXd bent_;              ///< targets x features, of the quadratic step
  Eigen::MatrixXd left_out_;          ///< targets x n
};

}  // namespace patina
