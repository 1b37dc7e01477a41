#include "engine/posterior/scores.h"

#include <Eigen/Eigenvalues>

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/posterior/least_squares.h"
#include "engine/posterior/quadratic_features.h"

namespace patina {
namespace {

// Shares of the summaries' mean variance along a direction of the photos' span.
constexpr std::array kPenalties{1e-4, 1e-3, 1e-2, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0};

/// The photos' Gram matrix X^T X, as far as it is not zero: vectors values vectors^T, from whichever of X^T X
/// and X X^T is the smaller.
struct Spectrum {
  Eigen::MatrixXd vectors;
  Eigen::VectorXd values;

  /// @param entries  X, entries x photos
  explicit Spectrum(const Eigen::MatrixXd& entries) {
    const bool few = entries.rows() < entries.cols();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
        few ? Eigen::MatrixXd(entries * entries.transpose())
            : Eigen::MatrixXd(entries.transpose() * entries));
    values = solver.eigenvalues().cwiseMax(0);
    vectors = few ? Eigen::MatrixXd(entries.transpose() * solver.eigenvectors()).colwise().normalized()
                  : solver.eigenvectors();
  }
};

/// Ridge regression of one target in the photos' span, and what it predicts of photos that are left out.
struct Fit {
  Eigen::VectorXd dual, left_out;
  double loss = std::numeric_limits<double>::infinity();
};

/// @param target  centred
Fit fit(const Eigen::VectorXd& target, const Spectrum& spectrum) {
  const auto& [vectors, values] = spectrum;
  const Eigen::VectorXd rotated = vectors.transpose() * target;
  const double of_mean = 1.0 / static_cast<double>(target.size()), unit = values.sum() * of_mean;
  Fit best;
  for (const double penalty : kPenalties) {
    const Eigen::ArrayXd damped = values.array() + penalty * unit;
    const Eigen::ArrayXd kept = values.array() / damped;
    const Eigen::VectorXd fitted = vectors * (kept * rotated.array()).matrix();
    const Eigen::ArrayXd leverages = (vectors.cwiseAbs2() * kept.matrix()).array() + of_mean;
    const Eigen::VectorXd errors = (target - fitted).array() / (1 - leverages).max(1e-3);
    if (errors.squaredNorm() >= best.loss) continue;
    best = {vectors * (rotated.array() / damped).matrix(), target - errors, errors.squaredNorm()};
  }
  return best;
}

}  // namespace

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
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    const Eigen::VectorXd target = places.row(i).transpose().array() - mean_place[i];
    const Fit best = fit(target, spectrum);
    weights_.row(i) = (precisions.asDiagonal() * (scaled * best.dual)).transpose();
    left_out_.row(i) = best.left_out.transpose().array() + mean_place[i];
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
