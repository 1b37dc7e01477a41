#include "engine/posterior/scores.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>

#include "tests/posterior/toy_simulator.h"

namespace patina {
namespace {

TEST(Scores, OfManyPhotosAreThePosteriorMean) {
  Rng rng(1);
  for (const ToySimulator& toy : {ToySimulator::independent(rng), ToySimulator::correlated(rng)}) {
    const Eigen::MatrixXd places = normals(rng, 2, 2000);
    const Scores scores(places, toy.photos(places, rng));
    const Eigen::VectorXd photo = toy.photo(rng.normals(2), rng);
    const Normal exact = exact_posterior(toy, photo);
    EXPECT_LT((scores(photo) - exact.mean).norm(), 0.15 * std::sqrt(exact.covariance.trace()));
  }
}

TEST(Scores, OfPhotosThatAreLeftOutAreWhatTheOthersMakeThem) {
  Rng rng(2);
  const ToySimulator toy = ToySimulator::correlated(rng);
  const Eigen::MatrixXd places = normals(rng, 2, 60), summaries = toy.photos(places, rng);
  const Scores scores(places, summaries);
  for (const Eigen::Index i : {0, 31}) {
    std::vector<Eigen::Index> others;
    for (Eigen::Index k = 0; k < 60; ++k)
      if (k != i) others.push_back(k);
    const Scores without(places(Eigen::all, others), summaries(Eigen::all, others));
    // Standardising, the penalty and the first step of the second know of the photo: a part of its own
    // effect.
    EXPECT_LT((scores.left_out().col(i) - without(summaries.col(i))).norm(),
              0.25 * (scores(summaries.col(i)) - without(summaries.col(i))).norm() + 0.01);
  }
}

TEST(Scores, KnowKnownErrorsBetterThanPhotosTeachThem) {
  constexpr Eigen::Index kEntries = 600, kPhotos = 100, kTried = 200;
  Rng rng(5);
  const Eigen::VectorXd sds = (0.5 * rng.normals(kEntries)).array().exp();
  const Eigen::MatrixXd told = normals(rng, kEntries, 2) / 10;  // slopes in units of the errors
  const Eigen::MatrixXd slopes = sds.asDiagonal() * told;
  const auto errors = [&](Eigen::Index photos) -> Eigen::MatrixXd {
    return sds.asDiagonal() * normals(rng, kEntries, photos);
  };
  const Eigen::MatrixXd places = normals(rng, 2, kPhotos), drawn = errors(kPhotos);
  const Eigen::MatrixXd summaries = slopes * places + drawn;
  const Scores known(places, summaries, {.sds = sds, .drawn = drawn}), learnt(places, summaries);
  const Eigen::MatrixXd photos = slopes * normals(rng, 2, kTried) + errors(kTried);
  const Eigen::MatrixXd covariance = (Eigen::MatrixXd::Identity(2, 2) + told.transpose() * told).inverse();
  const Eigen::MatrixXd exact = covariance * told.transpose() * sds.cwiseInverse().asDiagonal() * photos;
  const auto off = [&](const Scores& scores) {
    return (scores(photos) - exact).squaredNorm() / (kTried * covariance.trace());
  };
  EXPECT_LT(off(known), 0.1);
  EXPECT_GT(off(learnt), 0.5);
}

TEST(Scores, OfNothingButNoiseAreThePriorMean) {
  Rng rng(3);
  const Eigen::MatrixXd places = normals(rng, 2, 120);
  const Scores scores(places, normals(rng, 2000, 120));
  EXPECT_LT(scores(rng.normals(2000)).norm(), 0.5);
}

TEST(Scores, MakeNothingOfAnEntryThatNeverChanges) {
  Rng rng(4);
  const ToySimulator toy = ToySimulator::independent(rng);
  const Eigen::MatrixXd places = normals(rng, 2, 200);
  Eigen::MatrixXd summaries = toy.photos(places, rng);
  summaries.row(3).setConstant(7);
  const Scores scores(places, summaries);
  Eigen::VectorXd photo = summaries.col(0);
  const Eigen::VectorXd before = scores(photo);
  photo[3] = 1e6;
  EXPECT_EQ(scores(photo), before);
}

}  // namespace
}  // namespace patina
