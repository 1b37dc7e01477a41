#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "engine/error.h"
#include "engine/posterior/posterior.h"
#include "engine/run/manifest.h"
#include "engine/run/mode_state.h"
#include "engine/run/posterior_settings.h"
#include "engine/run/run_photo.h"
#include "engine/run/same_run.h"
#include "tests/run/run_fixture.h"

namespace patina {
namespace {

class WidenedRunTest : public RunTest {
 protected:
  static RunSettings widened() {
    RunSettings widened = settings();
    widened.errors = "widened";
    return widened;
  }

  std::vector<std::string> rows(const std::filesystem::path& folder) const {
    return rows_of(folder / "chain-1.csv");
  }
};

TEST_F(WidenedRunTest, ThatIsTakenUpAgainGoesOnToTheDrawsOfAnUndisturbedOne) {
  RunSettings asked = widened();
  draws_to_the_end(*start_run(asked, photo(), folder_ / "undisturbed"));
  asked.draws = 5;
  draws_to_the_end(*start(asked));
  asked.draws = widened().draws;
  draws_to_the_end(*resume_run(asked, photo(), directory()));
  EXPECT_EQ(rows(directory()), rows(folder_ / "undisturbed"));
}

TEST_F(WidenedRunTest, KeepsWhatItWidenedByAndItsModeIsUnderIt) {
  RunSettings asked = widened();
  asked.material = "leather";
  asked.map_only = true;
  draws_to_the_end(*start(asked));
  const Manifest manifest = read_manifest(directory());
  const Posterior by_hand(posterior_settings(manifest.settings, manifest.settings.resolution),
                          read_run_photo(directory()));
  const auto found = read_mode(directory(), run_key(manifest), by_hand, manifest.settings);
  ASSERT_TRUE(found && found->wider);
  const Position mode = found->mode.position;
  const double lp = by_hand.with(*found->wider).value(mode).log_density;
  EXPECT_NEAR(found->mode.evaluation.log_density, lp, 1e-3 * (1 + std::abs(lp)));
  EXPECT_GE(lp, by_hand.value(mode).log_density);
  EXPECT_EQ(manifest.map->lp, found->mode.evaluation.log_density);
}

TEST_F(WidenedRunTest, OfAnotherErrorModelIsNotTakenUp) {
  draws_to_the_end(*start(widened()));
  RunSettings other = widened();
  other.errors = "paper";
  EXPECT_THROW(resume_run(other, photo(), directory()), UserError);
}

}  // namespace
}  // namespace patina
