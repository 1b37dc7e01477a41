#include "engine/posterior/measure_photo_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/posterior/toy_simulator.h"

namespace patina {
namespace {

TEST(PhotoFit, OfAPhotoOfTheModelHasAUniformP) {
  Rng rng(7);
  constexpr int kPhotos = 400;
  double sum = 0;
  int widened = 0;
  for (int i = 0; i < kPhotos; ++i) {
    const ToySimulator toy = ToySimulator::correlated(rng);
    const Eigen::MatrixXd places = normals(rng, 2, 160);
    const Eigen::Vector2d truth = rng.normals(2);
    const PhotoFit fit = measure_photo_fit(places, toy.photos(places, rng), toy.photo(truth, rng), truth);
    sum += fit.p;
    widened += fit.widening > 1;
  }
  EXPECT_NEAR(sum / kPhotos, 0.5, 5 * std::sqrt(1.0 / 12 / kPhotos));
  EXPECT_NEAR(widened, 0.05 * kPhotos, 25);
}

TEST(PhotoFit, SaysHowFarAPhotoOfSomethingElseIsAndWidensTheErrors) {
  Rng rng(8);
  const ToySimulator toy = ToySimulator::independent(rng);
  const Eigen::MatrixXd places = normals(rng, 2, 400), summaries = toy.photos(places, rng);
  const Eigen::VectorXd far = 10 * toy.factor * Eigen::VectorXd::Ones(ToySimulator::kEntries);
  const Eigen::Vector2d centre(0, 0);
  const PhotoFit of_far = measure_photo_fit(places, summaries, far, centre);
  const PhotoFit of_near = measure_photo_fit(places, summaries, 0.1 * far, centre);
  EXPECT_NEAR(of_far.distance, 10, 1);
  EXPECT_LT(of_far.p, 0.01);
  EXPECT_GT(of_far.widening, 30);
  EXPECT_EQ(of_near.widening, 1);
}

}  // namespace
}  // namespace patina
