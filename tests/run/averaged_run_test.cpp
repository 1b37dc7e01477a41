#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "engine/material/registry.h"
#include "engine/posterior/posterior.h"
#include "engine/posterior/vetted_density.h"
#include "engine/run/emulated_proposals.h"
#include "engine/run/manifest.h"
#include "engine/run/mode_state.h"
#include "engine/run/posterior_settings.h"
#include "engine/run/run_photo.h"
#include "engine/run/same_run.h"
#include "tests/run/run_fixture.h"

namespace patina {
namespace {

class AveragedRun : public RunTest {
 protected:
  static RunSettings with_averages() {
    RunSettings asked = with_errors("averaged");
    asked.material = "leather";
    asked.resolution = settings().resolution;
    return asked;
  }

  /// Of the run in directory().
  Posterior by_hand() const {
    const Manifest manifest = read_manifest(directory());
    return {posterior_settings(manifest.settings, manifest.settings.resolution), read_run_photo(directory())};
  }
  ModeFound found() const {
    const Manifest manifest = read_manifest(directory());
    return read_mode(directory(), run_key(manifest), by_hand(), manifest.settings).value();
  }
};

TEST_F(AveragedRun, KeepsWhatItWidenedByAndItsModeIsUnderIt) {
  RunSettings asked = with_averages();
  asked.map_only = true;
  draws_to_the_end(*start(asked));
  const ModeFound found = this->found();
  ASSERT_TRUE(found.wider);
  const Position mode = found.mode.position;
  const double lp = by_hand().with(*found.wider).value(mode).log_density;
  EXPECT_NEAR(found.mode.evaluation.log_density, lp, 1e-3 * (1 + std::abs(lp)));
  EXPECT_GE(lp, by_hand().value(mode).log_density);
  EXPECT_EQ(read_manifest(directory()).map->lp, found.mode.evaluation.log_density);
}

TEST_F(AveragedRun, DrawsFromTheAverageThatItKeepsAfterAShortWarmUp) {
  RunSettings asked = with_averages();
  asked.warmup = 400;
  const std::vector<Draw> draws = draws_to_the_end(*start(asked));
  EXPECT_EQ(read_manifest(directory()).kernel, "emulated");
  const ModeFound found = this->found();
  ASSERT_TRUE(found.average && found.wider);
  const Posterior hand = by_hand();
  const auto density = averaged(hand, *found.wider, *found.average);
  int after = 0;
  for (const Draw& draw : draws) {
    if (draw.warmup) continue;
    ++after;
    const double lp = density->value(hand.position(draw.values)).log_density;
    EXPECT_NEAR(draw.lp, lp, 1e-3 * (1 + std::abs(lp)));
  }
  EXPECT_EQ(after, asked.chains * asked.draws);
  EXPECT_EQ(std::ssize(draws), asked.chains * (asked.draws + kAveragedWarmup));
  const auto opened = open_run(directory());
  EXPECT_EQ(opened->settings().warmup, 400) << "asked for";
  EXPECT_EQ(in_force(opened->settings(), opened->status()).warmup, kAveragedWarmup);
}

TEST_F(AveragedRun, AMatchAloneIsByHandSetErrorsAndDrawsThatFollowItAreAveraged) {
  RunSettings asked = with_averages();
  asked.errors = kAuto;
  asked.map_only = true;
  draws_to_the_end(*start(asked));
  const Manifest alone = read_manifest(directory());
  EXPECT_EQ(alone.errors, "paper");
  EXPECT_FALSE(found().wider);
  EXPECT_NEAR(alone.map->lp, by_hand().value(by_hand().position(alone.map->values)).log_density,
              1e-3 * (1 + std::abs(alone.map->lp)));

  asked.map_only = false;
  const auto run = resume_run(asked, photo(), directory());
  EXPECT_FALSE(draws_to_the_end(*run).empty());
  EXPECT_EQ(run->status().phase, RunPhase::finished) << run->status().message;
  const Manifest manifest = read_manifest(directory());
  const ModeFound found = this->found();
  EXPECT_EQ(manifest.settings.errors, kAuto);
  EXPECT_TRUE(found.wider && found.average);
  EXPECT_EQ(manifest.errors, "averaged");
  EXPECT_EQ(manifest.map->lp, found.mode.evaluation.log_density);
  EXPECT_GT(manifest.map->lp, alone.map->lp) << "wider errors forgive more";
  EXPECT_EQ(run->status().errors, manifest.errors);
  EXPECT_EQ(open_run(directory())->status().errors, manifest.errors);
}

/// Searches begin at fewer pixels and without covariances, whose summary has another length.
TEST_F(AveragedRun, GoesOnWhereItsSearchBeganByAnotherSummary) {
  RunSettings asked = with_averages();
  asked.summary = "gram+covariances";
  asked.resolution = 136;
  asked.map_only = true;
  const ParameterTable& table = material_table("leather");
  const ParameterValues usual = prior_location(table);
  for (std::size_t i = 0; i < table.continuous.size(); ++i)
    if (table.continuous[i].name != "light" && !table.continuous[i].place)
      asked.fixed[table.continuous[i].name] = usual.continuous[i];
  draws_to_the_end(*start(asked));
  const Posterior coarse(search_settings(asked, 128), read_run_photo(directory()));
  ASSERT_NE(coarse.photo_summary().size(), by_hand().photo_summary().size());
  ASSERT_TRUE(found().wider);
  const auto again = resume_run(asked, photo(), directory());
  draws_to_the_end(*again);
  EXPECT_EQ(again->status().phase, RunPhase::finished) << again->status().message;
}

TEST_F(AveragedRun, IsNotWhatAutoComesToWhereNothingIsJagged) {
  RunSettings asked = settings();
  ASSERT_EQ(asked.errors, kAuto);
  asked.map_only = true;
  draws_to_the_end(*start(asked));
  EXPECT_EQ(read_manifest(directory()).errors, "paper");
}

TEST_F(AveragedRun, HasNoAverageWhereRendersAreNotEmulated) {
  RunSettings asked = with_averages();
  asked.kernel = "hmc";
  draws_to_the_end(*start(asked));
  const ModeFound found = this->found();
  EXPECT_FALSE(found.average);
  EXPECT_TRUE(found.wider) << "the errors are those of the photo's irregularities and the render's";
  EXPECT_EQ(read_manifest(directory()).kernel, "hmc");
}

}  // namespace
}  // namespace patina
