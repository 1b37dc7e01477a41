#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/error.h"
#include "engine/run/manifest.h"
#include "engine/run/run_files.h"
#include "engine/run/state_file.h"
#include "tests/run/odd_photos.h"
#include "tests/run/run_fixture.h"

namespace patina {
namespace {

class CalibratedRunTest : public RunTest {
 protected:
  static RunSettings calibrated() { return with_errors("calibrated"); }
};

TEST_F(CalibratedRunTest, DrawsAndSaysHowThePhotoFits) {
  const auto run = start(calibrated());
  const RunSettings asked = calibrated();
  const auto draws = draws_to_the_end(*run);
  EXPECT_EQ(std::ranges::count(draws, false, &Draw::warmup), asked.chains * asked.draws);
  EXPECT_EQ(run->status().phase, RunPhase::finished);
  const Manifest manifest = read_manifest(directory());
  EXPECT_EQ(manifest.settings.errors, "calibrated");
  ASSERT_TRUE(manifest.photo_fit);
  EXPECT_GE(manifest.photo_fit->widening, 1);
  EXPECT_TRUE(manifest.map);
}

TEST_F(CalibratedRunTest, AnUnknownErrorModelIsRefusedWithThoseThatAreKnown) {
  RunSettings unknown = calibrated();
  unknown.errors = "guessed";
  try {
    start(unknown);
    FAIL();
  } catch (const UserError& error) {
    for (const char* word : {"guessed", "paper", "calibrated"})
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
  }
}

TEST_F(CalibratedRunTest, OfAPhotoOfSomethingElseSaysThatItDoesNotLookLikeTheMaterial) {
  const auto run = start_run(calibrated(), photo_of(green_hole_in_white()), directory());
  draws_to_the_end(*run);
  const Alarms alarms = run->status().alarms;
  const auto misfit = std::ranges::find(alarms, "misfit", &Alarm::name);
  ASSERT_TRUE(misfit != alarms.end());
  EXPECT_NE(misfit->sentence.find("another material"), std::string::npos) << misfit->sentence;
  EXPECT_EQ(read_manifest(directory()).photo_fit->discrepancy, 1);
}

TEST_F(CalibratedRunTest, ARunThatHasAlarmsCanBeTakenUpAgain) {
  RunSettings asked = settings();
  asked.draws = 5;
  const Photo white = photo_of([] {
    Image image(48, 48, 3);
    std::ranges::fill(image.pixels, 1.0F);
    return image;
  }());
  {
    const auto run = start_run(asked, white, directory());
    draws_to_the_end(*run);
    ASSERT_FALSE(run->status().alarms.empty());
  }
  asked.draws = 10;
  EXPECT_EQ(draws_to_the_end(*resume_run(asked, white, directory())).size() % 10, 0u);
}

}  // namespace
}  // namespace patina
