#include "engine/posterior/calibrate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/material/renderer.h"
#include "engine/sampling/map_search.h"

namespace patina {
namespace {

constexpr int kSmallResolution = 32;
constexpr Camera kSmall{.least_side = 0};
constexpr CalibrationSettings kFew{.pilot = 200, .round = 120, .most_rounds = 2};

/// Of cheap renders.
Posterior small_posterior(const std::string& material, const Image& photo) {
  PosteriorSettings settings;
  settings.material = material;
  settings.resolution = kSmallResolution;
  settings.summary = "rings";
  return Posterior(settings, photo);
}

/// With other irregularities than a posterior's.
Image photo_of_prior_location(const std::string& material) {
  const Renderer renderer(material, 2, Capture{});
  Rng rng(5);
  const int side = kSmallResolution * kSmall.oversampling;
  return photographed(renderer.render(prior_location(renderer.table()), side), kSmall, rng);
}

OptimizerResult match_of(const Posterior& posterior) {
  Rng rng(7);
  MapSearchSettings settings;
  settings.prior_draws = 16;
  settings.descents = 2;
  settings.finalists = 1;
  return search_map({&posterior}, rng, settings).best;
}

Calibration calibration_of(const Posterior& posterior, int threads = 1) {
  const auto pool = make_pool(posterior.table(), 100);
  const Simulator simulator{.posterior = posterior, .pool = *pool, .camera = kSmall, .threads = threads};
  const Pilot pilot(simulator, kFew.pilot);
  const OnDemand on_demand{.pilot = [&]() -> const Pilot& { return pilot; },
                           .match = [&] { return match_of(posterior).position.continuous; }};
  return calibrate(simulator, {}, on_demand, kFew);
}

Posterior calibrated(const Posterior& posterior) {
  return posterior.with(std::make_shared<const RegressedLikelihood>(calibration_of(posterior).likelihood));
}

TEST(Calibrate, LeavesPlacesAndLevelsTheirPrior) {
  const Posterior paper = small_posterior("plaster", photo_of_prior_location("plaster"));
  const Position centre = paper.position(prior_location(paper.table()));
  const Posterior posterior = calibrated(paper);
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

TEST(Calibrate, IsTheSameOnAnyNumberOfThreads) {
  const Posterior paper = small_posterior("bump", photo_of_prior_location("bump"));
  const Calibration one = calibration_of(paper, 1), two = calibration_of(paper, 2);
  EXPECT_EQ(one.mode, two.mode);
  EXPECT_EQ(one.likelihood.evaluate(one.mode).log_density, two.likelihood.evaluate(one.mode).log_density);
}

TEST(Calibrate, FindsTheLightAndColourThatAPhotoWasTakenWith) {
  const Posterior paper = small_posterior("bump", photo_of_prior_location("bump"));
  const Position truth = paper.position(prior_location(paper.table()));
  const Calibration found = calibration_of(paper);
  for (const char* name : {"light", "albedo_r", "albedo_g", "albedo_b"}) {
    const auto i = static_cast<Eigen::Index>(*paper.table().find_continuous(name));
    const double sd = std::sqrt(found.covariance(i, i));
    EXPECT_LT(std::abs(found.mode[i] - truth.continuous[i]), 4 * sd) << name;
    EXPECT_LT(sd, 1) << name;
  }
}

TEST(Calibrate, AllowsAPhotoOfSomethingElseTheHandSetErrorsAsWell) {
  const PhotoFit own = calibration_of(small_posterior("bump", photo_of_prior_location("bump"))).fit;
  const PhotoFit other = calibration_of(small_posterior("bump", photo_of_prior_location("translucent"))).fit;
  EXPECT_EQ(own.discrepancy, 0);
  EXPECT_GT(own.p, kRare);
  EXPECT_EQ(other.discrepancy, 1);
}

TEST(Calibrate, StaysNearTheMatchOfAPhotoOfSomethingElse) {
  const Posterior paper = small_posterior("bump", photo_of_prior_location("translucent"));
  const OptimizerResult match = match_of(paper);
  const auto behind = [&](const Eigen::VectorXd& at) {
    return match.evaluation.log_density - paper.value({at, match.position.discrete}).log_density;
  };
  EXPECT_LT(behind(calibration_of(paper).mode),
            0.01 * behind(paper.position(prior_location(paper.table())).continuous));
}

}  // namespace
}  // namespace patina
