#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "engine/posterior/region.h"
#include "engine/sampling/rng.h"

namespace patina {

inline Eigen::MatrixXd normals(Rng& rng, Eigen::Index rows, Eigen::Index columns) {
  return rng.normals(rows * columns).reshaped(rows, columns);
}

/// A simulator of which all is known: s = J u + F e, e ~ N(0, I), u of two coordinates.
struct ToySimulator {
  static constexpr Eigen::Index kEntries = 8, kCoordinates = 2;
  Eigen::MatrixXd slopes, factor;

  static ToySimulator correlated(Rng& rng) {
    return {normals(rng, kEntries, kCoordinates), normals(rng, kEntries, kEntries)};
  }
  static ToySimulator independent(Rng& rng) {
    const Eigen::VectorXd sds = (0.5 * rng.normals(kEntries)).array().exp();
    return {normals(rng, kEntries, kCoordinates), sds.asDiagonal()};
  }

  Eigen::VectorXd photo(const Eigen::VectorXd& u, Rng& rng) const {
    return slopes * u + factor * rng.normals(kEntries);
  }
  /// Of every column.
  Eigen::MatrixXd photos(const Eigen::MatrixXd& places, Rng& rng) const {
    Eigen::MatrixXd summaries(kEntries, places.cols());
    for (Eigen::Index i = 0; i < places.cols(); ++i) summaries.col(i) = photo(places.col(i), rng);
    return summaries;
  }
};

struct Normal {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

/// Of an unbent simulator, with the prior N(0, I).
inline Normal exact_posterior(const ToySimulator& toy, const Eigen::VectorXd& photo) {
  const Eigen::MatrixXd errors = toy.factor * toy.factor.transpose();
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(toy.slopes.cols(), toy.slopes.cols());
  const Eigen::MatrixXd covariance =
      (one + toy.slopes.transpose() * errors.llt().solve(toy.slopes)).llt().solve(one);
  return {covariance * toy.slopes.transpose() * errors.llt().solve(photo), covariance};
}

}  // namespace patina
