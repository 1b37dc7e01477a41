#include "engine/posterior/ridge.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "tests/posterior/toy_simulator.h"

namespace patina {
namespace {

TEST(Ridge, ErrorsAreThoseOfRegressionsWithoutThePhotoWhetherInputsAreFewOrMany) {
  constexpr Eigen::Index kPhotos = 30;
  Rng rng(1);
  for (const Eigen::Index size : {4, 50}) {
    const Eigen::MatrixXd inputs = normals(rng, size, kPhotos);
    const Eigen::VectorXd target = inputs.transpose() * rng.normals(size) + 3 * rng.normals(kPhotos);
    const RidgeFit fit = fit_ridge(target, Spectrum(inputs), Eigen::VectorXd::Zero(kPhotos));
    for (const Eigen::Index i : {0, 17}) {
      Eigen::MatrixXd others = inputs;
      others.col(i).setZero();
      const Eigen::MatrixXd gram =
          others * others.transpose() + fit.damping * Eigen::MatrixXd::Identity(size, size);
      const double predicted = inputs.col(i).dot(gram.llt().solve(others * target));
      EXPECT_NEAR(fit.errors[i], target[i] - predicted, 1e-6);
    }
  }
}

TEST(Ridge, ByNoiseThatIsToComeIsWhatItIsByMuchDrawnNoise) {
  constexpr Eigen::Index kInputs = 5, kPhotos = 20000;
  constexpr double kVariance = 2.5;
  Rng rng(3);
  const Eigen::MatrixXd inputs = normals(rng, kInputs, kPhotos);
  const Eigen::VectorXd target = inputs.transpose() * rng.normals(kInputs) + rng.normals(kPhotos);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(kPhotos);
  const Eigen::MatrixXd noisy = inputs + std::sqrt(kVariance) * normals(rng, kInputs, kPhotos);
  const RidgeFit to_come = fit_ridge(target, Spectrum(inputs), none, kVariance);
  const RidgeFit drawn = fit_ridge(target, Spectrum(noisy), none);
  const Eigen::VectorXd expected = noisy * drawn.dual;
  EXPECT_LT((inputs * to_come.dual - expected).norm(), 0.05 * expected.norm());
  EXPECT_NEAR(to_come.loss / drawn.loss, 1, 0.03);
  const RidgeFit without = fit_ridge(target, Spectrum(inputs), none);
  EXPECT_GT((inputs * without.dual - expected).norm(), 0.5 * expected.norm());
}

TEST(Ridge, TrustsWhatIsExactAndNothingThatIsNoise) {
  Rng rng(2);
  const Eigen::MatrixXd inputs = normals(rng, 20, 100);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(100), slopes = rng.normals(20);
  const RidgeFit exact = fit_ridge(inputs.transpose() * slopes, Spectrum(inputs), none);
  EXPECT_LT((inputs * exact.dual - slopes).norm(), 0.01 * slopes.norm());
  const Eigen::VectorXd noise = rng.normals(100);
  const RidgeFit nothing = fit_ridge(noise, Spectrum(inputs), none);
  EXPECT_LT((inputs * nothing.dual).norm(), 0.1);
  EXPECT_LT(nothing.loss, 1.05 * noise.squaredNorm());
}

}  // namespace
}  // namespace patina
