#include <gtest/gtest.h>

#include <cmath>

#include "engine/posterior/posterior.h"
#include "engine/run/manifest.h"
#include "engine/run/mode_state.h"
#include "engine/run/posterior_settings.h"
#include "engine/run/run_photo.h"
#include "engine/run/same_run.h"
#include "tests/run/run_fixture.h"

namespace patina {
namespace {

class WidenedRunTest : public RunTest {};

TEST_F(WidenedRunTest, KeepsWhatItWidenedByAndItsModeIsUnderIt) {
  RunSettings asked = settings();
  asked.errors = "widened";
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

}  // namespace
}  // namespace patina
