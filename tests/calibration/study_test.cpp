#include "engine/calibration/study.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/calibration/coverage.h"

namespace patina {
namespace {

constexpr int kPhotos = 12;

/// Of cheap renders, a photo of which takes a fraction of a second.
StudySettings small_study() {
  StudySettings study;
  study.posterior.material = "bump";
  study.posterior.summary = "rings";
  study.posterior.resolution = 32;
  study.errors = "calibrated";
  study.simulations = {.pilot = 300, .round = 120, .most_rounds = 3};
  study.camera.least_side = 0;  // cheap photos
  study.warmup = 150;
  study.draws = 200;
  return study;
}

/// The places of all identified parameters of all photos, and of none but those.
std::vector<double> places_of(const StudySettings& settings) {
  const CalibrationStudy study(settings, 1, {});
  std::vector<double> places;
  for (int photo = 1; photo <= kPhotos; ++photo)
    for (const TruthAndPosterior& quantity : study.run(photo).quantities)
      if (quantity.sd_over_prior_sd < 0.9) places.push_back(quantity.place);
  return places;
}

TEST(CalibrationStudy, FindsIntervalsOfCalibratedErrorsAboutRightAndOfATenthOfThemFarTooNarrow) {
  const Coverage right = coverage(places_of(small_study()));
  StudySettings sure = small_study();
  sure.error_scale = 0.1;
  const Coverage narrow = coverage(places_of(sure));
  ASSERT_GT(right.count, 3 * kPhotos);
  // Parameters of one photo are not independent: twice the binomial error and more.
  EXPECT_NEAR(right.share[2], 0.9, 0.15);
  EXPECT_LT(narrow.share[2], 0.7);
}

TEST(CalibrationStudy, IntervalsOfAveragedErrorsHoldTheTruthOftenEnough) {
  StudySettings averaged = small_study();
  averaged.errors = "averaged";
  const Coverage held = coverage(places_of(averaged));
  ASSERT_GT(held.count, 2 * kPhotos);
  EXPECT_GT(held.share[2], 0.8);
}

TEST(CalibrationStudy, APhotoIsTheSameWhoeverWasThereBefore) {
  StudySettings settings = small_study();
  settings.simulations.pilot = 200;
  const CalibrationStudy study(settings, 1, {});
  const PhotoOutcome alone = study.run(3);
  study.run(2);
  const PhotoOutcome after = study.run(3);
  ASSERT_EQ(alone.quantities.size(), study.quantities().size());
  for (std::size_t i = 0; i < alone.quantities.size(); ++i)
    EXPECT_EQ(alone.quantities[i].place, after.quantities[i].place);
}

}  // namespace
}  // namespace patina
