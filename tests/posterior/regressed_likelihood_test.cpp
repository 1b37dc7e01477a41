#include "engine/posterior/regressed_likelihood.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "engine/sampling/archive.h"
#include "engine/sampling/map_search.h"
#include "engine/sampling/optimizer.h"
#include "tests/posterior/toy_simulator.h"

namespace patina {
namespace {

/// Of all entries as scores, photos simulated of the prior.
RegressedLikelihood likelihood_of(const ToySimulator& toy, Eigen::Index photos, const Eigen::VectorXd& photo,
                                  Rng& rng) {
  const Eigen::MatrixXd places = normals(rng, 2, photos);
  return {prior_region(2), places, toy.photos(places, rng), photo};
}

/// With the prior N(0, I).
class ToyPosterior final : public LogDensity {
 public:
  explicit ToyPosterior(RegressedLikelihood likelihood) : likelihood_(std::move(likelihood)) {}
  Eigen::Index dimension() const override { return 2; }
  Evaluation evaluate(const Position& position) const override {
    Evaluation evaluation = likelihood_.evaluate(position.continuous);
    evaluation.log_density -= 0.5 * position.continuous.squaredNorm();
    evaluation.gradient -= position.continuous;
    return evaluation;
  }

 private:
  RegressedLikelihood likelihood_;
};

Normal approximate_posterior(const RegressedLikelihood& likelihood) {
  const ToyPosterior posterior(likelihood);
  OptimizerSettings tight;
  tight.gradient_tolerance = 1e-7;
  tight.value_tolerance = 1e-12;
  const Position mode = maximize(posterior, {Eigen::VectorXd::Zero(2), {}}, tight).position;
  return {mode.continuous, laplace_covariance(posterior, mode)};
}

TEST(RegressedLikelihood, OfManySimulationsMakesTheExactPosterior) {
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

TEST(RegressedLikelihood, OfARegionIsThatOfThePrior) {
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

TEST(RegressedLikelihood, HasTheGradientThatDifferencesHaveInsideTheSimulatedRegionAndBeyond) {
  Rng rng(3);
  const ToySimulator toy = ToySimulator::correlated(rng);
  const Eigen::VectorXd photo = toy.photo(rng.normals(2), rng);
  const RegressedLikelihood normal = likelihood_of(toy, 100, photo, rng);
  for (const RegressedLikelihood& likelihood : {normal, normal.heavy_tailed(5)})
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

TEST(RegressedLikelihood, OfHeavyTailsIsTheTOfTheNormalOnesMisfitAndNormalOfManyDegrees) {
  Rng rng(12);
  const ToySimulator toy = ToySimulator::correlated(rng);
  const RegressedLikelihood normal = likelihood_of(toy, 300, toy.photo(rng.normals(2), rng), rng);
  for (const Eigen::Vector2d& at : {Eigen::Vector2d(0.1, 0.2), Eigen::Vector2d(-1.5, 2)}) {
    const double square = -2 * normal.evaluate(at).log_density;
    EXPECT_NEAR(normal.heavy_tailed(5).evaluate(at).log_density, -0.5 * (5 + 2) * std::log(1 + square / 5),
                1e-9 * (1 + square));
    EXPECT_NEAR(normal.heavy_tailed(1e9).evaluate(at).log_density, -0.5 * square, 1e-5 * (1 + square));
  }
}

TEST(RegressedLikelihood, DoubtsWhatIsHardlyToldAndLeavesTheRest) {
  // The first coordinate is seen with a tenth of the prior's variance, the second with twice as much.
  Rng rng(14);
  const Eigen::MatrixXd places = normals(rng, 2, 20'000);
  const Eigen::MatrixXd errors =
      Eigen::Vector2d(std::sqrt(0.1), std::sqrt(2)).asDiagonal() * normals(rng, 2, 20'000);
  const RegressedLikelihood all(prior_region(2), places, places + errors, Eigen::Vector2d(0, 0));
  const Normal doubted = approximate_posterior(all.doubted());
  const auto precision = [](double p) { return p * p / (1 + p); };
  EXPECT_NEAR(doubted.covariance(0, 0), 1 / (1 + precision(10)), 0.01);
  EXPECT_NEAR(doubted.covariance(1, 1), 1 / (1 + precision(0.5)), 0.03);
}

TEST(RegressedLikelihood, DoesNotKnowWhatScoresDoNotTell) {
  // Twenty scores of nothing, and no more than a hundred photos that agree by chance.
  Rng rng(4);
  const Eigen::MatrixXd places = normals(rng, 2, 100), scores = normals(rng, 20, 100);
  const Normal found = approximate_posterior({prior_region(2), places, scores, rng.normals(20)});
  EXPECT_GT(found.covariance.diagonal().minCoeff(), 0.75);
  EXPECT_LT(found.mean.norm(), 1);
}

TEST(RegressedLikelihood, HasTheErrorsOfPhotosLikeThisOne) {
  // Scores of two coordinates, the first with errors that grow with it.
  Rng rng(10);
  const Eigen::MatrixXd places = normals(rng, 2, 2000);
  const auto score = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    return v + 0.2 * Eigen::Vector2d(std::exp(v[0]), 1).cwiseProduct(rng.normals(2));
  };
  Eigen::MatrixXd scores(2, places.cols());
  for (Eigen::Index i = 0; i < places.cols(); ++i) scores.col(i) = score(places.col(i));
  const auto sds = [&](double first) -> Eigen::VectorXd {
    const Eigen::VectorXd seen = Eigen::Vector2d(first, 0);
    return approximate_posterior({prior_region(2), places, scores, seen}).covariance.diagonal().cwiseSqrt();
  };
  const Eigen::ArrayXd growth = sds(1).array() / sds(-1).array();
  EXPECT_GT(growth[0], 1.4) << "of all photos, weighted by how near they seem, it would be 1.2";
  EXPECT_NEAR(growth[1], 1, 0.1);
}

TEST(RegressedLikelihood, OfAPhotoLikeNoneThatWasSimulatedIsOfMostOfThem) {
  Rng rng(11);
  const Eigen::MatrixXd places = normals(rng, 2, 200), scores = places + 0.3 * normals(rng, 2, 200);
  const Eigen::VectorXd far = Eigen::Vector2d(30, -30);
  const Normal found = approximate_posterior({prior_region(2), places, scores, far});
  const Normal near = approximate_posterior({prior_region(2), places, scores, Eigen::Vector2d(1, -1)});
  EXPECT_GT(found.covariance.diagonal().minCoeff(), near.covariance.diagonal().maxCoeff());
}

/// The share of toy photos whose truth lies in the central 90 % interval of their first coordinate.
/// @param degrees  of freedom of the errors' t distribution; 0: normal
double coverage_of(Eigen::Index photos, int degrees, Rng& rng) {
  constexpr int kStudies = 400;
  constexpr double kNinetyPercent = 1.645;
  const auto size = [&] { return degrees ? std::sqrt(degrees / rng.normals(degrees).squaredNorm()) : 1; };
  int held = 0;
  for (int study = 0; study < kStudies; ++study) {
    const ToySimulator toy = ToySimulator::correlated(rng);
    const auto photo = [&](const Eigen::VectorXd& u) -> Eigen::VectorXd {
      return toy.slopes * u + 2 * size() * toy.factor * rng.normals(ToySimulator::kEntries);
    };
    const Eigen::MatrixXd places = normals(rng, 2, photos);
    Eigen::MatrixXd scores(ToySimulator::kEntries, photos);
    for (Eigen::Index i = 0; i < photos; ++i) scores.col(i) = photo(places.col(i));
    const Eigen::VectorXd truth = rng.normals(2);
    const Normal found = approximate_posterior({prior_region(2), places, scores, photo(truth)});
    held += std::abs(found.mean[0] - truth[0]) < kNinetyPercent * std::sqrt(found.covariance(0, 0));
  }
  return static_cast<double>(held) / kStudies;
}

TEST(RegressedLikelihood, OfFewPhotosHasIntervalsThatHoldTheTruthAndOfHeavyTailsNearly) {
  Rng rng(9);
  // The binomial error is 0.015.
  EXPECT_NEAR(coverage_of(40, 0, rng), 0.9, 0.05);
  EXPECT_NEAR(coverage_of(300, 0, rng), 0.9, 0.05);
  const double of_heavy_tails = coverage_of(300, 3, rng);
  EXPECT_GT(of_heavy_tails, 0.8);
  EXPECT_LT(of_heavy_tails, 0.95);
}

/// Of the ranks that truths' log posterior densities have among those of draws: chi-square of five bins.
/// @param photos  that are simulated   @param degrees  of freedom that the likelihood is given
double chi_square_of_ranks(Eigen::Index photos, double degrees, Rng& rng) {
  constexpr int kStudies = 1000, kDraws = 1000, kBins = 5;
  Eigen::ArrayXd counts = Eigen::ArrayXd::Zero(kBins);
  for (int study = 0; study < kStudies; ++study) {
    const Eigen::MatrixXd places = normals(rng, 2, photos);
    const Eigen::MatrixXd scores = places + 0.5 * normals(rng, 2, photos);
    const Eigen::VectorXd truth = rng.normals(2), seen = truth + 0.5 * rng.normals(2);
    const ToyPosterior posterior(
        RegressedLikelihood(prior_region(2), places, scores, seen).heavy_tailed(degrees));
    const double of_truth = posterior.evaluate({truth, {}}).log_density;
    double below = 0, all = 0;
    for (int draw = 0; draw < kDraws; ++draw) {
      const Eigen::VectorXd at = rng.normals(2);  // of the prior, weighted by the likelihood
      const double of_draw = posterior.evaluate({at, {}}).log_density;
      const double weight = std::exp(of_draw + 0.5 * at.squaredNorm());
      all += weight;
      if (of_draw < of_truth) below += weight;
    }
    counts[std::min(kBins - 1, static_cast<int>(kBins * below / all))] += 1;
  }
  constexpr double kExpected = static_cast<double>(kStudies) / kBins;
  return (counts - kExpected).square().sum() / kExpected;
}

TEST(RegressedLikelihood, OfHeavyTailsRanksTruthsEvenlyWhereFewPhotosTellTheErrors) {
  Rng rng(13);
  constexpr double kOneInThousand = 18.5;  // of a chi-square of 4 degrees of freedom
  EXPECT_LT(chi_square_of_ranks(40, 6, rng), kOneInThousand);
  EXPECT_GT(chi_square_of_ranks(40, 1e9, rng), kOneInThousand) << "and normal errors do not";
}

TEST(RegressedLikelihood, DoesNotTrustAFarAwayPointWhereNothingWasSimulated) {
  Rng rng(5);
  ToySimulator toy = ToySimulator::independent(rng);
  toy.slopes.setZero();  // scores would be as good everywhere
  const RegressedLikelihood likelihood =
      likelihood_of(toy, 300, toy.photo(Eigen::Vector2d::Zero(), rng), rng);
  const double near = likelihood.evaluate(Eigen::Vector2d(1, 1)).log_density;
  EXPECT_LT(likelihood.evaluate(Eigen::Vector2d(20, 0)).log_density, near - 50);
}

TEST(RegressedLikelihood, WidenedFourTimesDoublesTheSdOfItsPosteriorUnderAFlatPrior) {
  Rng rng(6);
  const ToySimulator toy = ToySimulator::independent(rng);
  const RegressedLikelihood likelihood =
      likelihood_of(toy, 4000, toy.photo(Eigen::Vector2d::Zero(), rng), rng);
  const auto precision = [](const RegressedLikelihood& of) {
    return (approximate_posterior(of).covariance.inverse() - Eigen::MatrixXd::Identity(2, 2)).eval();
  };
  const Eigen::MatrixXd before = precision(likelihood), after = precision(likelihood.widened(4));
  EXPECT_LT((before - 4 * after).norm(), 0.05 * before.norm());
}

TEST(RegressedLikelihood, IsTheSameFromItsArchive) {
  Rng rng(8);
  const ToySimulator toy = ToySimulator::correlated(rng);
  RegressedLikelihood likelihood = likelihood_of(toy, 100, toy.photo(rng.normals(2), rng), rng);
  Archive written;
  written(likelihood);
  Archive read(written.take_bytes());
  RegressedLikelihood again;
  read(again);
  read.expect_end();
  const Eigen::Vector2d at(0.3, -0.8);
  EXPECT_EQ(again.evaluate(at).log_density, likelihood.evaluate(at).log_density);
  EXPECT_EQ(again.evaluate(at).gradient, likelihood.evaluate(at).gradient);
}

}  // namespace
}  // namespace patina
