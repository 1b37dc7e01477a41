#include "engine/posterior/ridge.h"

#include <Eigen/Eigenvalues>

#include <array>

namespace patina {
namespace {

// Shares of the inputs' mean variance along a direction of their span.
constexpr std::array kPenalties{1e-4, 1e-3, 1e-2, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0};

}  // namespace

Spectrum::Spectrum(const Eigen::MatrixXd& inputs) {
  const bool few = inputs.rows() < inputs.cols();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      few ? Eigen::MatrixXd(inputs * inputs.transpose()) : Eigen::MatrixXd(inputs.transpose() * inputs));
  values = solver.eigenvalues().cwiseMax(0);
  vectors = few ? Eigen::MatrixXd(inputs.transpose() * solver.eigenvectors()).colwise().normalized()
                : solver.eigenvectors();
}

RidgeFit fit_ridge(const Eigen::VectorXd& target, const Spectrum& spectrum,
                   const Eigen::VectorXd& mean_leverages, double noise) {
  const auto& [vectors, values] = spectrum;
  const Eigen::VectorXd rotated = vectors.transpose() * target;
  const auto count = static_cast<double>(target.size());
  const double unit = values.sum() / count;
  RidgeFit best;
  for (const double penalty : kPenalties) {
    const double damping = penalty * unit + count * noise;
    const Eigen::ArrayXd damped = values.array() + damping;
    const Eigen::ArrayXd kept = values.array() / damped;
    const Eigen::VectorXd fitted = vectors * (kept * rotated.array()).matrix();
    const Eigen::ArrayXd leverages = (vectors.cwiseAbs2() * kept.matrix() + mean_leverages).array();
    const Eigen::VectorXd errors = (target - fitted).array() / (1 - leverages).max(1e-9);
    const Eigen::ArrayXd dual = rotated.array() / damped;
    const double loss = errors.squaredNorm() + count * noise * (values.array() * dual.square()).sum();
    if (loss >= best.loss) continue;
    best = {vectors * dual.matrix(), errors, damping, leverages.mean(), loss};
  }
  return best;
}

}  // namespace patina
