#include "engine/posterior/synthetic_likelihood.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <cmath>
#include <numeric>

#include "engine/sampling/map_search.h"
#include "engine/sampling/optimizer.h"
#include "engine/sampling/rng.h"

namespace patina {
namespace {

constexpr Eigen::Index kEntries = 8, kCoordinates = 2;
constexpr double kFloor = 1e-6;

Eigen::MatrixXd normals(Rng& rng, Eigen::Index rows, Eigen::Index columns) {
  return rng.normals(rows * columns).reshaped(rows, columns);
}

/// A simulator of which all is known: s = J u + bend u_0^2 + F e, e ~ N(0, I).
struct Simulator {
  Eigen::MatrixXd slopes, factor;
  Eigen::VectorXd bend = Eigen::VectorXd::Zero(kEntries);

  Eigen::VectorXd photo(const Eigen::VectorXd& u, Rng& rng) const {
    return slopes * u + bend * u[0] * u[0] + factor * rng.normals(kEntries);
  }
  /// Photos of N(0, I).
  SimulatedPhotos simulate(Rng& rng, Eigen::Index count) const {
    SimulatedPhotos photos{Eigen::VectorXd::Zero(kCoordinates),
                           Eigen::MatrixXd::Identity(kCoordinates, kCoordinates),
                           {0, 1},
                           normals(rng, kCoordinates, count),
                           Eigen::MatrixXd(kEntries, count)};
    for (Eigen::Index i = 0; i < count; ++i) photos.summaries.col(i) = photo(photos.offsets.col(i), rng);
    return photos;
  }
};

Simulator correlated(Rng& rng) {
  return {normals(rng, kEntries, kCoordinates), normals(rng, kEntries, kEntries)};
}

Simulator independent(Rng& rng) {
  const Eigen::VectorXd sds = (0.5 * rng.normals(kEntries)).array().exp();
  return {normals(rng, kEntries, kCoordinates), sds.asDiagonal()};
}

/// With the prior N(0, I).
class ToyPosterior final : public LogDensity {
 public:
  explicit ToyPosterior(SyntheticLikelihood likelihood) : likelihood_(std::move(likelihood)) {}
  Eigen::Index dimension() const override { return kCoordinates; }
  Evaluation evaluate(const Position& position) const override {
    Evaluation evaluation = likelihood_.evaluate(position.continuous);
    evaluation.log_density -= 0.5 * position.continuous.squaredNorm();
    evaluation.gradient -= position.continuous;
    return evaluation;
  }

 private:
  SyntheticLikelihood likelihood_;
};

struct Normal {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

Normal exact_posterior(const Simulator& toy, const Eigen::VectorXd& photo) {
  const Eigen::MatrixXd errors = toy.factor * toy.factor.transpose();
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(kCoordinates, kCoordinates);
  const Eigen::MatrixXd covariance =
      (one + toy.slopes.transpose() * errors.llt().solve(toy.slopes)).llt().solve(one);
  return {covariance * toy.slopes.transpose() * errors.llt().solve(photo), covariance};
}

Normal approximate_posterior(const SyntheticLikelihood& likelihood) {
  const ToyPosterior posterior(likelihood);
  OptimizerSettings tight;
  tight.gradient_tolerance = 1e-7;
  tight.value_tolerance = 1e-12;
  const Position mode = maximize(posterior, {Eigen::VectorXd::Zero(kCoordinates), {}}, tight).position;
  return {mode.continuous, laplace_covariance(posterior, mode)};
}

TEST(SyntheticLikelihood, OfManySimulationsMakesTheExactPosterior) {
  Rng rng(1);
  for (const Simulator& toy : {independent(rng), correlated(rng)}) {
    const Eigen::VectorXd photo = toy.photo(0.5 * rng.normals(kCoordinates), rng);
    const Normal exact = exact_posterior(toy, photo);
    const Normal found = approximate_posterior(SyntheticLikelihood(toy.simulate(rng, 4000), photo, kFloor));
    // Eight entries are no more than scores and components, so that nothing is lost; an estimated variance
    // of 4000 photos errs by 2 %.
    EXPECT_LT((found.covariance - exact.covariance).norm(), 0.1 * exact.covariance.norm());
    EXPECT_LT((found.mean - exact.mean).norm(), 0.15 * std::sqrt(exact.covariance.trace()));
  }
}

TEST(SyntheticLikelihood, HasTheGradientThatDifferencesHaveInsideTheSimulatedRegionAndBeyond) {
  Rng rng(2);
  Simulator toy = correlated(rng);
  toy.bend = rng.normals(kEntries);
  const SyntheticLikelihood likelihood(toy.simulate(rng, 100), toy.photo(rng.normals(2), rng), kFloor);
  for (const double reach : {0.5, 9.0}) {
    const Eigen::VectorXd at = reach * Eigen::Vector2d(0.8, -0.6);
    for (Eigen::Index i = 0; i < kCoordinates; ++i) {
      const Eigen::VectorXd step = 1e-5 * Eigen::VectorXd::Unit(kCoordinates, i);
      const double slope =
          (likelihood.evaluate(at + step).log_density - likelihood.evaluate(at - step).log_density) / 2e-5;
      EXPECT_NEAR(likelihood.evaluate(at).gradient[i], slope, 1e-5 * (1 + std::abs(slope)));
    }
  }
}

TEST(SyntheticLikelihood, FollowsAMeanThatIsBent) {
  Rng rng(3);
  Simulator toy = independent(rng);
  toy.bend = 3 * rng.normals(kEntries);
  toy.factor *= 0.05;
  const Eigen::Vector2d truth(0.8, -0.3);
  const SyntheticLikelihood likelihood(toy.simulate(rng, 300), toy.photo(truth, rng), kFloor);
  const ToyPosterior posterior(likelihood);
  const Position mode = maximize(posterior, {truth, {}}).position;
  EXPECT_LT((mode.continuous - truth).norm(), 0.2);
  EXPECT_GT(likelihood.evaluate(truth).log_density,
            likelihood.evaluate(Eigen::Vector2d(-0.8, -0.3)).log_density);
}

TEST(SyntheticLikelihood, DoesNotTrustAFarAwayPointWhereNothingWasSimulated) {
  Rng rng(4);
  Simulator toy = independent(rng);
  toy.slopes.setZero();  // scores would be as good everywhere
  const SyntheticLikelihood likelihood(toy.simulate(rng, 300), toy.photo(Eigen::Vector2d::Zero(), rng),
                                       kFloor);
  const double near = likelihood.evaluate(Eigen::Vector2d(1, 1)).log_density;
  EXPECT_LT(likelihood.evaluate(Eigen::Vector2d(20, 0)).log_density, near - 50);
}

TEST(SyntheticLikelihood, LeavesCoordinatesThatArePlacesAlone) {
  Rng rng(5);
  const Simulator toy = independent(rng);
  SimulatedPhotos photos = toy.simulate(rng, 100);
  photos.centre = Eigen::Vector3d::Zero();
  photos.informed = {0, 2};
  const SyntheticLikelihood likelihood(photos, toy.photo(Eigen::Vector2d::Zero(), rng), kFloor);
  const Evaluation here = likelihood.evaluate(Eigen::Vector3d(0.3, 0, 0.2));
  EXPECT_EQ(here.log_density, likelihood.evaluate(Eigen::Vector3d(0.3, 5, 0.2)).log_density);
  EXPECT_EQ(here.gradient[1], 0);
  EXPECT_NE(here.gradient[2], 0);
}

/// The likelihood of one score at a distance x in units of its estimated error, the true variance v
/// integrated out under Jeffreys' prior: given nu degrees of freedom v has density
/// v^-(nu / 2 + 1) exp(-nu / (2 v)).
double integrated_likelihood(double x, double nu) {
  double sum = 0;
  for (double log_v = -8; log_v < 12; log_v += 1e-3) {
    const double v = std::exp(log_v);
    sum += std::pow(v, -0.5) * std::exp(-x * x / (2 * v)) * std::pow(v, -nu / 2 - 1) *
           std::exp(-nu / (2 * v)) * v;
  }
  return std::log(sum);
}

TEST(SyntheticLikelihood, OfFewSimulationsIsTheNormalOneWithItsVarianceIntegratedOut) {
  // One entry, s = u + e: the second 12 photos and the features 1, v, v^2 leave 9 degrees of freedom.
  Rng rng(6);
  SimulatedPhotos photos{
      Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Identity(1, 1), {0}, normals(rng, 1, 24), {}};
  photos.summaries = photos.offsets + normals(rng, 1, 24);
  const Eigen::VectorXd v = photos.offsets.rightCols(12).transpose();
  const Eigen::VectorXd s = photos.summaries.rightCols(12).transpose();
  Eigen::MatrixXd design(12, 3);
  design << Eigen::VectorXd::Ones(12), v, v.cwiseAbs2();
  const Eigen::VectorXd fitted = design.colPivHouseholderQr().solve(s);
  const double variance = (s - design * fitted).squaredNorm() / 9 * (1 + 3.0 / 12);
  const Eigen::VectorXd photo = Eigen::VectorXd::Constant(1, fitted[0]);
  const SyntheticLikelihood likelihood(photos, photo, kFloor);
  const auto expected = [&](double u) {
    return integrated_likelihood((fitted[1] * u + fitted[2] * u * u) / std::sqrt(variance), 9);
  };
  for (const double u : {-1.5, 0.7, 2.0})
    EXPECT_NEAR(likelihood.evaluate(Eigen::VectorXd::Constant(1, u)).log_density -
                    likelihood.evaluate(Eigen::VectorXd::Zero(1)).log_density,
                expected(u) - expected(0), 1e-4);
}

TEST(SyntheticLikelihood, IsNotSurerForEntriesThatAreNothingButNoise) {
  // 2000 entries, none of which knows the coordinates: the posterior is the prior, whatever chance suggests.
  Rng rng(9);
  SimulatedPhotos photos{Eigen::VectorXd::Zero(2),
                         Eigen::MatrixXd::Identity(2, 2),
                         {0, 1},
                         normals(rng, 2, 120),
                         normals(rng, 2000, 120)};
  const SyntheticLikelihood likelihood(photos, rng.normals(2000), kFloor);
  EXPECT_GT(approximate_posterior(likelihood).covariance.trace(), 0.7 * 2);
}

TEST(PhotoFit, OfAPhotoOfTheModelHasAUniformP) {
  Rng rng(7);
  constexpr int kPhotos = 400;
  double sum = 0;
  int widened = 0;
  for (int i = 0; i < kPhotos; ++i) {
    const Simulator toy = correlated(rng);
    const PhotoFit fit =
        SyntheticLikelihood(toy.simulate(rng, 160), toy.photo(Eigen::Vector2d::Zero(), rng), kFloor).fit();
    sum += fit.p;
    widened += fit.widening > 1;
  }
  EXPECT_NEAR(sum / kPhotos, 0.5, 5 * std::sqrt(1.0 / 12 / kPhotos));
  EXPECT_NEAR(widened, 0.05 * kPhotos, 25);
}

TEST(PhotoFit, SaysHowFarAPhotoOfSomethingElseIsAndWidensTheErrors) {
  Rng rng(8);
  const Simulator toy = independent(rng);
  const SimulatedPhotos photos = toy.simulate(rng, 400);
  const Eigen::VectorXd far = 10 * toy.factor * Eigen::VectorXd::Ones(kEntries);
  const SyntheticLikelihood of_far(photos, far, kFloor), of_near(photos, 0.1 * far, kFloor);
  EXPECT_NEAR(of_far.fit().distance, 10, 1);
  EXPECT_LT(of_far.fit().p, 0.01);
  EXPECT_GT(of_far.fit().widening, 30);
  EXPECT_EQ(of_near.fit().widening, 1);
}

}  // namespace
}  // namespace patina
