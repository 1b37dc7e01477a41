#include "engine/posterior/wider_errors.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "engine/sampling/archive.h"

namespace patina {
namespace {

constexpr std::uint64_t kStream = 0x7769'6465;  // apart from what calibration simulates

}  // namespace

bool WiderErrors::are_of(Eigen::Index entries) const {
  const Eigen::Index n = variances.size();
  if (directions.rows() != entries || directions.cols() != n || !directions.allFinite() ||
      !variances.allFinite() || !(variances.array() >= 0).all())
    return false;
  constexpr double kRounding = 1e-6;
  const Eigen::MatrixXd products = directions.transpose() * directions;
  return (products - Eigen::MatrixXd::Identity(n, n)).norm() <= kRounding;
}

void WiderErrors::serialise(Archive& archive) { archive(directions, variances); }

WiderErrors errors_of_irregularities(const Simulator& simulator, const Position& at, int photos) {
  constexpr double kTimes = 2;       // the photo's and the render's
  constexpr double kMatters = 0.02;  // of a hand-set error's variance
  const Eigen::VectorXd centre = at.continuous(simulator.posterior.informed());
  const Region there{centre, Eigen::MatrixXd::Zero(centre.size(), centre.size())};
  const Eigen::VectorXd precision = simulator.posterior.hand_set_errors().cwiseInverse();
  Eigen::MatrixXd scatter = precision.asDiagonal() * simulate(simulator, there, photos, kStream).summaries;
  scatter.colwise() -= scatter.rowwise().mean().eval();
  scatter *= std::sqrt(kTimes / (photos - 1));
  // Entries are many and photos few: the covariance's axes by those of the products between photos.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(scatter.transpose() * scatter);
  const Eigen::Index n = (axes.eigenvalues().array() > kMatters).count();
  const Eigen::VectorXd variances = axes.eigenvalues().tail(n);
  return {scatter * axes.eigenvectors().rightCols(n) * variances.cwiseSqrt().cwiseInverse().asDiagonal(),
          variances.cwiseMin(kTimes * kWidest)};
}

}  // namespace patina
