#include "engine/posterior/calibrate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/material/renderer.h"
#include "engine/posterior/synthetic_likelihood.h"
#include "engine/sampling/map_search.h"

namespace patina {
namespace {

constexpr int kResolution = 32;

/// Of cheap renders.
Posterior small_posterior(const std::string& material, const Image& photo) {
  PosteriorSettings settings;
  settings.material = material;
  settings.resolution = kResolution;
  settings.summary = "rings";
  return Posterior(settings, photo);
}

/// With other irregularities than a posterior's.
Image photo_of_prior_location(const std::string& material) {
  const Renderer renderer(material, 2, Capture{});
  const Camera camera;
  Rng rng(5);
  const int side = kResolution * camera.oversampling;
  return photographed(renderer.render(prior_location(renderer.table()), side), camera, rng);
}

SimulationSettings few() { return {.photos = 100, .rounds = 2, .camera = {}, .seed = 1}; }

Eigen::MatrixXd identity(const Posterior& of) {
  return 0.25 * Eigen::MatrixXd::Identity(of.dimension(), of.dimension());
}

TEST(Calibrate, LeavesPlacesAndLevelsTheirPrior) {
  const Posterior paper = small_posterior("plaster", photo_of_prior_location("plaster"));
  const Position centre = paper.position(prior_location(paper.table()));
  const auto pool = make_pool(paper.table(), 100);
  const Posterior posterior = paper.calibrated_around(centre, identity(paper), few(), *pool);
  EXPECT_TRUE(posterior.jagged().empty());
  const auto likelihood = [](const Posterior& of, const Position& at) {
    return of.value(at).log_density + 0.5 * at.continuous.squaredNorm();
  };
  int places = 0;
  for (Eigen::Index i = 0; i < posterior.dimension(); ++i) {
    Position elsewhere = centre;
    elsewhere.continuous[i] += 0.7;
    const bool place = paper.table().continuous[static_cast<std::size_t>(i)].place;
    places += place;
    if (place)
      EXPECT_NEAR(likelihood(posterior, elsewhere), likelihood(posterior, centre), 1e-9);
    else
      EXPECT_NE(likelihood(posterior, elsewhere), likelihood(posterior, centre));
  }
  EXPECT_EQ(places, 2);
  Position other = centre;
  other.discrete[0] = 1;
  EXPECT_EQ(posterior.value(other).log_density, posterior.value(centre).log_density);
}

TEST(Calibrate, IsTheSameWheneverItIsDone) {
  const Posterior paper = small_posterior("bump", photo_of_prior_location("bump"));
  const Position centre = paper.position(prior_location(paper.table()));
  const auto once = make_pool(paper.table(), 100), again = make_pool(paper.table(), 100);
  const CalibratedPosterior a = calibrate(paper, centre, identity(paper), few(), *once);
  const CalibratedPosterior b = calibrate(paper, centre, identity(paper), few(), *again);
  EXPECT_EQ(a.mode.continuous, b.mode.continuous);
  EXPECT_EQ(a.at_mode.log_density, b.at_mode.log_density);
}

TEST(Calibrate, SaysThatAPhotoOfAnotherMaterialDoesNotFit) {
  const auto fit_of = [](const std::string& photographed) {
    const Posterior paper = small_posterior("bump", photo_of_prior_location(photographed));
    const Position centre = paper.position(prior_location(paper.table()));
    const auto pool = make_pool(paper.table(), 100);
    return *calibrate(paper, centre, identity(paper), few(), *pool).posterior.fit();
  };
  const PhotoFit own = fit_of("bump"), other = fit_of("translucent");
  EXPECT_LT(own.distance, other.distance / 2);
  EXPECT_LT(other.p, 0.05);
  EXPECT_GT(other.widening, own.widening);
}

}  // namespace
}  // namespace patina
