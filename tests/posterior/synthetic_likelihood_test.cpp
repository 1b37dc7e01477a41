#include "engine/posterior/synthetic_likelihood.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>

#include "engine/sampling/archive.h"
#include "engine/sampling/map_search.h"
#include "engine/sampling/optimizer.h"
#include "tests/posterior/toy_simulator.h"

namespace patina {
namespace {

/// Of all entries as scores, photos simulated of the prior.
SyntheticLikelihood likelihood_of(const ToySimulator& toy, Eigen::Index photos, const Eigen::VectorXd& photo,
                                  Rng& rng) {
  const Eigen::MatrixXd places = normals(rng, 2, photos);
  return {prior_region(2), places, toy.photos(places, rng), photo};
}

/// With the prior N(0, I).
class ToyPosterior final : public LogDensity {
 public:
  explicit ToyPosterior(SyntheticLikelihood likelihood) : likelihood_(std::move(likelihood)) {}
  Eigen::Index dimension() const override { return 2; }
  Evaluation evaluate(const Position& position) const override {
    Evaluation evaluation = likelihood_.evaluate(position.continuous);
    evaluation.log_density -= 0.5 * position.continuous.squaredNorm();
    evaluation.gradient -= position.continuous;
    return evaluation;
  }

 private:
  SyntheticLikelihood likelihood_;
};

Normal approximate_posterior(const SyntheticLikelihood& likelihood) {
  const ToyPosterior posterior(likelihood);
  OptimizerSettings tight;
  tight.gradient_tolerance = 1e-7;
  tight.value_tolerance = 1e-12;
  const Position mode = maximize(posterior, {Eigen::VectorXd::Zero(2), {}}, tight).position;
  return {mode.continuous, laplace_covariance(posterior, mode)};
}

TEST(SyntheticLikelihood, OfManySimulationsMakesTheExactPosterior) {
  Rng rng(1);
  for (const ToySimulator& toy : {ToySimulator::independent(rng), ToySimulator::correlated(rng)}) {
    const Eigen::VectorXd photo = toy.photo(0.5 * rng.normals(2), rng);
    const Normal exact = exact_posterior(toy, photo);
    const Normal found = approximate_posterior(likelihood_of(toy, 4000, photo, rng));
    // A variance estimated of 4000 photos errs by 2 %.
    EXPECT_LT((found.covariance - exact.covariance).norm(), 0.1 * exact.covariance.norm());
    EXPECT_LT((found.mean - exact.mean).norm(), 0.15 * std::sqrt(exact.covariance.trace()));
  }
}

TEST(SyntheticLikelihood, OfARegionIsThatOfThePrior) {
  Rng rng(2);
  const ToySimulator toy = ToySimulator::correlated(rng);
  const Eigen::VectorXd photo = toy.photo(0.5 * rng.normals(2), rng);
  const Normal exact = exact_posterior(toy, photo);
  const Region region = region_around(exact.mean, exact.covariance, prior_region(2));
  const Eigen::MatrixXd offsets = normals(rng, 2, 4000);
  const Eigen::MatrixXd places = (region.factor * offsets).colwise() + region.centre;
  const Normal found = approximate_posterior({region, offsets, toy.photos(places, rng), photo});
  EXPECT_LT((found.covariance - exact.covariance).norm(), 0.1 * exact.covariance.norm());
  EXPECT_LT((found.mean - exact.mean).norm(), 0.15 * std::sqrt(exact.covariance.trace()));
}

TEST(SyntheticLikelihood, HasTheGradientThatDifferencesHaveInsideTheSimulatedRegionAndBeyond) {
  Rng rng(3);
  ToySimulator toy = ToySimulator::correlated(rng);
  toy.bend = rng.normals(ToySimulator::kEntries);
  const Eigen::VectorXd photo = toy.photo(rng.normals(2), rng);
  const SyntheticLikelihood likelihood = likelihood_of(toy, 100, photo, rng);
  for (const double reach : {0.5, 9.0}) {
    const Eigen::VectorXd at = reach * Eigen::Vector2d(0.8, -0.6);
    for (Eigen::Index i = 0; i < 2; ++i) {
      const Eigen::VectorXd step = 1e-5 * Eigen::VectorXd::Unit(2, i);
      const double slope =
          (likelihood.evaluate(at + step).log_density - likelihood.evaluate(at - step).log_density) / 2e-5;
      EXPECT_NEAR(likelihood.evaluate(at).gradient[i], slope, 1e-5 * (1 + std::abs(slope)));
    }
  }
}

TEST(SyntheticLikelihood, FollowsAMeanThatIsBent) {
  Rng rng(4);
  ToySimulator toy = ToySimulator::independent(rng);
  toy.bend = 3 * rng.normals(ToySimulator::kEntries);
  toy.factor *= 0.05;
  const Eigen::Vector2d truth(0.8, -0.3);
  const SyntheticLikelihood likelihood = likelihood_of(toy, 300, toy.photo(truth, rng), rng);
  const ToyPosterior posterior(likelihood);
  const Position mode = maximize(posterior, {truth, {}}).position;
  EXPECT_LT((mode.continuous - truth).norm(), 0.2);
  EXPECT_GT(likelihood.evaluate(truth).log_density,
            likelihood.evaluate(Eigen::Vector2d(-0.8, -0.3)).log_density);
}

TEST(SyntheticLikelihood, DoesNotTrustAFarAwayPointWhereNothingWasSimulated) {
  Rng rng(5);
  ToySimulator toy = ToySimulator::independent(rng);
  toy.slopes.setZero();  // scores would be as good everywhere
  const SyntheticLikelihood likelihood =
      likelihood_of(toy, 300, toy.photo(Eigen::Vector2d::Zero(), rng), rng);
  const double near = likelihood.evaluate(Eigen::Vector2d(1, 1)).log_density;
  EXPECT_LT(likelihood.evaluate(Eigen::Vector2d(20, 0)).log_density, near - 50);
}

TEST(SyntheticLikelihood, WidenedFourTimesDoublesTheSdOfItsPosteriorUnderAFlatPrior) {
  Rng rng(6);
  const ToySimulator toy = ToySimulator::independent(rng);
  const SyntheticLikelihood likelihood =
      likelihood_of(toy, 4000, toy.photo(Eigen::Vector2d::Zero(), rng), rng);
  const auto precision = [](const SyntheticLikelihood& of) {
    return (approximate_posterior(of).covariance.inverse() - Eigen::MatrixXd::Identity(2, 2)).eval();
  };
  const Eigen::MatrixXd before = precision(likelihood), after = precision(likelihood.widened(4));
  EXPECT_LT((before - 4 * after).norm(), 0.05 * before.norm());
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
  // One entry, s = u + e: 12 photos and the features 1, v, v^2 leave 9 degrees of freedom.
  Rng rng(7);
  const Eigen::MatrixXd offsets = normals(rng, 1, 12), scores = offsets + normals(rng, 1, 12);
  const Eigen::VectorXd v = offsets.transpose(), s = scores.transpose();
  Eigen::MatrixXd design(12, 3);
  design << Eigen::VectorXd::Ones(12), v, v.cwiseAbs2();
  const Eigen::VectorXd fitted = design.colPivHouseholderQr().solve(s);
  const double variance = (s - design * fitted).squaredNorm() / 9 * (1 + 3.0 / 12);
  const SyntheticLikelihood likelihood(prior_region(1), offsets, scores,
                                       Eigen::VectorXd::Constant(1, fitted[0]));
  const auto expected = [&](double u) {
    return integrated_likelihood((fitted[1] * u + fitted[2] * u * u) / std::sqrt(variance), 9);
  };
  for (const double u : {-1.5, 0.7, 2.0})
    EXPECT_NEAR(likelihood.evaluate(Eigen::VectorXd::Constant(1, u)).log_density -
                    likelihood.evaluate(Eigen::VectorXd::Zero(1)).log_density,
                expected(u) - expected(0), 1e-4);
}

TEST(SyntheticLikelihood, IsTheSameFromItsArchive) {
  Rng rng(8);
  const ToySimulator toy = ToySimulator::correlated(rng);
  SyntheticLikelihood likelihood = likelihood_of(toy, 100, toy.photo(rng.normals(2), rng), rng);
  Archive written;
  written(likelihood);
  Archive read(written.take_bytes());
  SyntheticLikelihood again;
  read(again);
  read.expect_end();
  const Eigen::Vector2d at(0.3, -0.8);
  EXPECT_EQ(again.evaluate(at).log_density, likelihood.evaluate(at).log_density);
  EXPECT_EQ(again.evaluate(at).gradient, likelihood.evaluate(at).gradient);
}

}  // namespace
}  // namespace patina
