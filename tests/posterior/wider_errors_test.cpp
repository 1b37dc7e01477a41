#include "engine/posterior/wider_errors.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <string>

#include "engine/material/renderer.h"
#include "engine/sampling/archive.h"
#include "engine/sampling/prior_draw.h"

namespace patina {
namespace {

/// Of the 12 colours of renders of 16 pixels.
Posterior small_posterior(const std::string& material = "bump", double mean_sigma = 0.05) {
  PosteriorSettings settings;
  settings.material = material;
  settings.resolution = 16;
  settings.summary = "means";
  settings.mean_sigma = mean_sigma;
  const Renderer renderer(material, 9, Capture{});
  return Posterior(settings, renderer.render(prior_location(renderer.table()), 16));
}

/// Two directions that are neither axes nor each other's mirror.
WiderErrors oblique(Eigen::Index entries) {
  Rng rng(2);
  Eigen::MatrixXd some(entries, 2);
  for (auto column : some.colwise()) column = rng.normals(entries);
  some.col(0).normalize();
  some.col(1) -= some.col(0) * some.col(0).dot(some.col(1));
  some.col(1).normalize();
  return {some, Eigen::Vector2d(3, 0.5)};
}

Eigen::MatrixXd covariance_of(const WiderErrors& wider) {
  const Eigen::Index entries = wider.directions.rows();
  return Eigen::MatrixXd::Identity(entries, entries) +
         wider.directions * wider.variances.asDiagonal() * wider.directions.transpose();
}

Position somewhere(const Posterior& posterior, std::uint64_t seed) {
  Rng rng(seed);
  return prior_draw(posterior, rng);
}

TEST(WiderErrors, MakeTheDensityThatOfTheWholeCovariance) {
  const Posterior by_hand = small_posterior();
  const Eigen::VectorXd photo = by_hand.in_errors(by_hand.photo_summary());
  const WiderErrors wider = oblique(photo.size());
  const Posterior posterior = by_hand.with(wider);
  const Eigen::LLT<Eigen::MatrixXd> covariance(covariance_of(wider));
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    const Position at = somewhere(posterior, seed);
    const Eigen::VectorXd residual = by_hand.predicted(at) - photo;
    const double squares = residual.dot(covariance.solve(residual));
    const double truth = -(at.continuous.squaredNorm() + squares) / 2;
    EXPECT_NEAR(posterior.value(at).log_density, truth, 1e-4 * (1 + std::abs(truth)));
    EXPECT_GT(posterior.value(at).log_density, by_hand.value(at).log_density);
    const Eigen::VectorXd white = posterior.predicted(at) - posterior.in_errors(posterior.photo_summary());
    EXPECT_NEAR(white.squaredNorm(), squares, 1e-4 * (1 + squares));
  }
}

TEST(WiderErrors, HaveTheGradientThatDifferencesHave) {
  const Posterior by_hand = small_posterior();
  const Posterior posterior = by_hand.with(oblique(by_hand.photo_summary().size()));
  const Position at = somewhere(posterior, 3);
  const Eigen::VectorXd gradient = posterior.evaluate_with_whole_gradient(at).gradient;
  const std::vector<bool> jagged = posterior.jagged();
  for (Eigen::Index i = 0; i < at.continuous.size(); ++i) {
    if (jagged[static_cast<std::size_t>(i)]) continue;
    constexpr double kStep = 3e-3;
    Position up = at, down = at;
    up.continuous[i] += kStep;
    down.continuous[i] -= kStep;
    const double difference =
        (posterior.value(up).log_density - posterior.value(down).log_density) / (2 * kStep);
    EXPECT_NEAR(gradient[i], difference, 0.02 * (1 + std::abs(difference))) << i;
  }
}

TEST(WiderErrors, LeaveAPredictionItsOwnBestExplanationAndMisfitsInHandSetErrors) {
  const Posterior by_hand = small_posterior();
  const Posterior posterior = by_hand.with(oblique(by_hand.photo_summary().size()));
  const Position at = somewhere(posterior, 5);
  const Posterior of_itself = posterior.given(posterior.predicted(at));
  EXPECT_NEAR(of_itself.value(at).log_density, -at.continuous.squaredNorm() / 2, 1e-4);
  EXPECT_DOUBLE_EQ(posterior.misfit(at).front().in_errors, by_hand.misfit(at).front().in_errors);
}

constexpr double kSmall = 0.002;  // an error beside which irregularities matter at 16 pixels
constexpr int kPhotos = 400;      // a variance of so many is within 7 %
const Camera kSmallCamera{.least_side = 32};

WiderErrors of_irregularities(const Posterior& posterior, const Position& at, int photos) {
  const auto pool = make_pool(posterior.table(), kSimulatedSeeds);
  const Simulator simulator{.posterior = posterior, .pool = *pool, .camera = kSmallCamera, .seed = 4};
  return errors_of_irregularities(simulator, at, photos);
}

TEST(ErrorsOfIrregularities, AreTwiceTheScatterOfPhotosThatOtherIrregularitiesMake) {
  const Posterior posterior = small_posterior("bump", kSmall);
  const Position at{Eigen::VectorXd::Zero(posterior.dimension()), {}};
  const WiderErrors wider = of_irregularities(posterior, at, kPhotos);
  const Eigen::MatrixXd added =
      covariance_of(wider) -
      Eigen::MatrixXd::Identity(posterior.photo_summary().size(), posterior.photo_summary().size());
  std::vector<Image> photos;
  for (int i = 0; i < kPhotos; ++i) {
    Rng rng(77, static_cast<std::uint64_t>(i));
    const Irregularities z(5000 + static_cast<std::uint64_t>(i));
    photos.push_back(posterior.simulated_photo(at, z, kSmallCamera, rng));
  }
  Eigen::MatrixXd scatter =
      posterior.hand_set_errors().cwiseInverse().asDiagonal() * posterior.simulated_summaries(photos);
  scatter.colwise() -= scatter.rowwise().mean().eval();
  const Eigen::MatrixXd twice = 2 * scatter * scatter.transpose() / (kPhotos - 1);
  ASSERT_GT(twice.trace(), 1);  // there is something to measure
  EXPECT_NEAR(added.trace() / twice.trace(), 1, 0.25);
  EXPECT_LT((added - twice).norm(), 0.4 * twice.norm());
}

TEST(ErrorsOfIrregularities, AreNoWiderThanIsBelievedOfOneMatch) {
  const Posterior posterior = small_posterior("bump", kSmall / 100);
  const Position at{Eigen::VectorXd::Zero(posterior.dimension()), {}};
  EXPECT_EQ(of_irregularities(posterior, at, 40).of_the_photo().variances.maxCoeff(), kWidest);
}

TEST(ErrorsOfIrregularities, AreOrthogonalDirectionsThatFitTheSummary) {
  const Posterior posterior = small_posterior("leather", kSmall);
  const WiderErrors wider = of_irregularities(posterior, somewhere(posterior, 6), 40);
  ASSERT_GT(wider.variances.size(), 0);
  const Eigen::MatrixXd products = wider.directions.transpose() * wider.directions;
  EXPECT_LT((products - Eigen::MatrixXd::Identity(products.rows(), products.cols())).norm(), 1e-6);
  EXPECT_TRUE(wider.are_of(posterior.photo_summary().size()));
}

TEST(WiderErrors, ThatAreDamagedOrOfAnotherSummaryAreNoticed) {
  const WiderErrors wider = oblique(12);
  EXPECT_TRUE(wider.are_of(12));
  EXPECT_FALSE(wider.are_of(13));
  WiderErrors damaged = wider;
  damaged.variances[0] = -1;
  EXPECT_FALSE(damaged.are_of(12));
  damaged = wider;
  damaged.directions(3, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(damaged.are_of(12));
  damaged = wider;
  damaged.variances.conservativeResize(1);
  EXPECT_FALSE(damaged.are_of(12));
  damaged = wider;
  damaged.directions.col(0) *= 2;
  EXPECT_FALSE(damaged.are_of(12));
}

TEST(WiderErrors, ComeBackFromAnArchiveAsTheyWere) {
  WiderErrors wider = oblique(12), read;
  Archive writing;
  wider.serialise(writing);
  Archive reading(writing.take_bytes());
  read.serialise(reading);
  EXPECT_EQ(read.directions, wider.directions);
  EXPECT_EQ(read.variances, wider.variances);
}

}  // namespace
}  // namespace patina
