#include "engine/run/predicted_start.h"

#include <gtest/gtest.h>

#include <atomic>

#include "engine/material/renderer.h"
#include "engine/posterior/calibrate.h"
#include "engine/posterior/camera.h"
#include "engine/posterior/prior_transform.h"
#include "engine/run/calibrated_errors.h"

namespace patina {
namespace {

/// As large as photos are simulated, for pixels of fewer are no means. Irregularities that are not rare ones
/// themselves: a hundredth of all photos are taken for such.
Image photo_of_bump() {
  const Renderer renderer("bump", 3, Capture{});
  return renderer.render(prior_location(renderer.table()), Camera{}.least_side);
}

PosteriorSettings small_settings() {
  PosteriorSettings settings;
  settings.resolution = 32;
  settings.summary = "rings";
  return settings;
}

TEST(RegionGuess, IsThePredictorsNormalDistributionWherePriorsAreItsOwn) {
  const Image photo = photo_of_bump();
  const Posterior posterior(small_settings(), photo);
  const Region region = region_guess(posterior, Capture{}).region(photo);
  const Prediction prediction = prediction_for("bump", photo, Capture{});
  ASSERT_EQ(region.centre.size(), prediction.mean.size());
  EXPECT_LT((region.centre - prediction.mean).norm(), 1e-4);
  EXPECT_EQ(region.centre, region_guess(posterior, Capture{}).centre(photo));
  const Eigen::ArrayXd sds = region.factor.rowwise().norm();
  EXPECT_LT((sds / prediction.deviations().array() - 1).abs().maxCoeff(), 0.15) << "of 400 draws";
}

TEST(RegionGuess, IsInThePosteriorsOwnCoordinates) {
  const Image photo = photo_of_bump();
  const TruncatedNormal prior{1200, 600, 100, 3000};
  PosteriorSettings settings = small_settings();
  settings.priors["light"] = prior;
  settings.fixed["rough"] = 0.3;
  const Posterior posterior(settings, photo);
  const Region region = region_guess(posterior, Capture{}).region(photo);
  const Prediction prediction = prediction_for("bump", photo, Capture{});
  EXPECT_EQ(region.centre.size(), prediction.mean.size() - 1);
  const std::size_t light = *prediction.table.find_continuous("light");
  const Eigen::VectorXd at = region.centre;
  EXPECT_NEAR(PriorTransform(prior).value(at[static_cast<Eigen::Index>(light)]),
              prediction.likeliest().continuous[light], 1);
}

TEST(LearnErrors, NeedsNoPilotForAPhotoThatTheMaterialCanMake) {
  const Image photo = photo_of_bump();
  const Posterior posterior(small_settings(), photo);
  std::atomic<int> simulated{0};
  const CalibratedMode found = learn_errors(
      posterior, photo, Capture{}, 1, [&] { ++simulated; },
      []() -> Position { throw std::logic_error("the photo is one that the material can make"); });
  EXPECT_GT(found.errors.fit.p, kRare);
  EXPECT_GT(simulated, 0);
  EXPECT_LT(simulated, CalibrationSettings().pilot);
}

}  // namespace
}  // namespace patina
