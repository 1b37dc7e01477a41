#include <algorithm>
#include <atomic>
#include <cmath>

#include "engine/material/registry.h"
#include "engine/posterior/posterior.h"
#include "engine/run/manifest.h"
#include "engine/run/mode_state.h"
#include "engine/run/posterior_settings.h"
#include "engine/run/run_photo.h"
#include "engine/run/same_run.h"
#include "tests/run/run_fixture.h"

namespace patina {
namespace {

using namespace std::chrono_literals;

/// A chain file without its clock.
std::string without_times(const std::filesystem::path& file) {
  const std::string text = slurp(file);
  return text.substr(0, text.find("#  Elapsed Time"));
}

ModeFound found_in(const std::filesystem::path& folder) {
  const Manifest manifest = read_manifest(folder);
  const Posterior posterior(posterior_settings(manifest.settings, manifest.settings.resolution),
                            read_run_photo(folder));
  return read_mode(folder, run_key(manifest), posterior, manifest.settings).value();
}

class SamplerRunTest : public RunTest {
 protected:
  /// So that whoever looks for it, however late it gets its turn, sees it go on.
  static RunSettings with_a_long_search() {
    RunSettings settings = endless();
    settings.resolution = 96;
    return settings;
  }
};

TEST_F(SamplerRunTest, EveryTransitionIsARowAndADrawAndIsCounted) {
  const auto run = start(settings());
  const std::vector<Draw> draws = draws_to_the_end(*run);
  const RunStatus status = run->status();
  EXPECT_EQ(status.phase, RunPhase::finished) << status.message;
  EXPECT_EQ(status.message, "finished: 60 draws");
  ASSERT_EQ(draws.size(), 2u * (40 + 30));
  std::vector<std::int64_t> next(2);
  for (const Draw& draw : draws) {
    EXPECT_EQ(draw.iteration, next[static_cast<std::size_t>(draw.chain)]++);
    EXPECT_EQ(draw.warmup, draw.iteration < 40);
    EXPECT_TRUE(std::isfinite(draw.lp));
    EXPECT_EQ(draw.values.continuous.size(), run->table().continuous.size());
  }
  for (const ChainStatus& chain : status.chains) EXPECT_EQ(chain.iteration, 70);
  for (const char* name : {"chain-1.csv", "chain-2.csv"}) EXPECT_EQ(rows_of(directory() / name).size(), 70u);
}

TEST_F(SamplerRunTest, WhatTheSearchHasMetIsKeptAtAnyMomentAndWhenItIsStopped) {
  const auto run = start(with_a_long_search());
  ASSERT_TRUE(comes_true([&] { return read_manifest(directory()).so_far.has_value(); }))
      << "as if it were killed now";
  EXPECT_FALSE(read_manifest(directory()).map);
  run->stop();
  draws_to_the_end(*run);
  const RunStatus ended = run->status();
  EXPECT_EQ(ended.phase, RunPhase::stopped);
  EXPECT_NE(ended.message.find("is kept"), std::string::npos) << ended.message;
  const RunStatus read = open_run(directory())->status();
  ASSERT_TRUE(read.best && ended.best);
  EXPECT_EQ(*read.best, *ended.best);
  EXPECT_EQ(read.best_lp, ended.best_lp);
  const auto again = resume_run(with_a_long_search(), photo(), directory());
  EXPECT_FALSE(has_ended(*again)) << again->status().message;
  EXPECT_TRUE(read_manifest(directory()).so_far) << "until there is a better one";
}

struct Emulated {
  std::string material, errors;
};
class EmulatedRun : public SamplerRunTest, public testing::WithParamInterface<Emulated> {};
INSTANTIATE_TEST_SUITE_P(SmoothJaggedAndAveraged, EmulatedRun,
                         testing::Values(Emulated{"bump", "paper"}, Emulated{"leather", "paper"},
                                         Emulated{"leather", "averaged"}),
                         [](const auto& info) { return info.param.material + "_" + info.param.errors; });

TEST_P(EmulatedRun, GoesOnFromWhereItWasStoppedToTheSameDraws) {
  RunSettings emulated = settings();
  emulated.material = GetParam().material;
  emulated.errors = GetParam().errors;
  emulated.kernel = "emulated";
  emulated.warmup = 500;  // long enough to be stopped in
  emulated.draws = 60;
  const auto whole = start_run(emulated, photo(), folder_ / "whole");
  draws_to_the_end(*whole);
  EXPECT_EQ(whole->status().phase, RunPhase::finished) << whole->status().message;
  emulated.map_only = true;
  emulated.draws = 20;
  const auto searched = start_run(emulated, photo(), folder_ / "parts");
  draws_to_the_end(*searched);
  emulated.map_only = false;
  const auto warming = resume_run(emulated, photo(), folder_ / "parts");
  ASSERT_TRUE(comes_true([&] { return warming->status().phase == RunPhase::warming_up; }));
  warming->stop();
  draws_to_the_end(*warming);
  EXPECT_FALSE(found_in(folder_ / "parts").has_learnt_again)
      << "so that it is learnt again by another program";
  draws_to_the_end(*resume_run(emulated, photo(), folder_ / "parts"));
  emulated.draws = 60;
  const auto rest = resume_run(emulated, photo(), folder_ / "parts");
  draws_to_the_end(*rest);
  for (const char* name : {"chain-1.csv", "chain-2.csv"})
    EXPECT_EQ(without_times(folder_ / "parts" / name), without_times(folder_ / "whole" / name));
  EXPECT_EQ(found_in(folder_ / "parts").has_learnt_again, GetParam().errors == "paper");
}

TEST_F(SamplerRunTest, ProposalsAreNotLearntAgainWithoutWarmUp) {
  RunSettings emulated = settings();
  emulated.kernel = "emulated";
  emulated.warmup = 0;
  draws_to_the_end(*start(emulated));
  const ModeFound found = found_in(directory());
  EXPECT_TRUE(found.emulator);
  EXPECT_FALSE(found.has_learnt_again);
}

TEST_F(SamplerRunTest, RunJsonTellsWhichKernelItTookByItself) {
  const auto kernel_of = [&](const std::string& kernel, int temper) {
    RunSettings asked = settings();
    asked.kernel = kernel;
    asked.temper = temper;
    const auto folder = folder_ / (kernel + std::to_string(temper));
    draws_to_the_end(*start_run(asked, photo(), folder));
    return read_manifest(folder).kernel;
  };
  EXPECT_EQ(kernel_of("auto", 0), "emulated");
  EXPECT_EQ(kernel_of("auto", 2), "hmc");
  EXPECT_EQ(kernel_of("nuts", 0), "nuts");
}

TEST_F(SamplerRunTest, AllDrawsStayInsideThePriorsBoxAndTheBestIsNotWorseThanAnyDraw) {
  RunSettings with_prior = settings();
  with_prior.priors["rough"] = {0.4, 0.1, 0.35, 0.45};
  with_prior.fixed["light"] = 1234;
  const auto run = start(with_prior);
  double highest = -INFINITY;
  const std::size_t rough = *run->table().find_continuous("rough");
  const std::size_t light = *run->table().find_continuous("light");
  EXPECT_EQ(run->table().continuous[rough].prior, with_prior.priors["rough"]);
  for (const Draw& draw : draws_to_the_end(*run)) {
    for (std::size_t i = 0; i < draw.values.continuous.size(); ++i) {
      EXPECT_GE(draw.values.continuous[i], run->table().continuous[i].prior.low);
      EXPECT_LE(draw.values.continuous[i], run->table().continuous[i].prior.high);
    }
    EXPECT_EQ(draw.values.continuous[light], 1234);
    highest = std::max(highest, draw.lp);
  }
  ASSERT_TRUE(run->status().best);
  EXPECT_EQ(run->status().best->continuous[light], 1234);
  EXPECT_GE(run->status().best_lp, highest - 1e-3);
}

TEST_F(SamplerRunTest, TheSameSeedWritesTheSameFilesAndAnotherSeedOthers) {
  const auto file_of = [&](const char* name, std::uint64_t seed) {
    RunSettings seeded = settings();
    seeded.seed = seed;
    const auto run = start_run(seeded, photo(), folder_ / name);
    draws_to_the_end(*run);
    return without_times(folder_ / name / "chain-2.csv");
  };
  const std::string first = file_of("a", 11);
  EXPECT_EQ(file_of("b", 11), first);
  EXPECT_NE(file_of("c", 12), first);
}

TEST_F(SamplerRunTest, ChainsOfOneRunDiffer) {
  draws_to_the_end(*start(settings()));
  EXPECT_NE(rows_of(directory() / "chain-1.csv"), rows_of(directory() / "chain-2.csv"));
}

TEST_F(SamplerRunTest, DiscreteParametersMove) {
  RunSettings leather = settings();
  leather.material = "leather";
  leather.alpha = 0.5;
  const auto run = start(leather);
  std::vector<int> seen;
  for (const Draw& draw : draws_to_the_end(*run)) {
    ASSERT_EQ(draw.values.discrete.size(), 2u);
    seen.push_back(draw.values.discrete[0] + 3 * draw.values.discrete[1]);
  }
  std::ranges::sort(seen);
  EXPECT_GT(std::ranges::unique(seen).begin() - seen.begin(), 1);
}

TEST_F(SamplerRunTest, WithoutASummaryTheMaterialsOwnIsUsedAndWrittenDown) {
  RunSettings unnamed = settings();
  unnamed.summary.clear();
  unnamed.map_only = true;
  draws_to_the_end(*start(unnamed));
  EXPECT_EQ(read_manifest(directory()).settings.summary, material_table("bump").summary);
}

TEST_F(SamplerRunTest, JaggedCoordinatesDecideWhatNobodyAskedForAndItIsWrittenDown) {
  const auto used_for = [&](const std::string& material, const std::string& kernel) {
    RunSettings asked = settings();
    asked.material = material;
    asked.kernel = kernel;
    asked.warmup.reset();
    const auto folder = folder_ / (material + kernel);
    start_run(asked, photo(), folder)->stop();
    return read_manifest(folder).settings;
  };
  const RunSettings of_smooth = used_for("bump", "hmc"), of_jagged = used_for("leather", "hmc");
  EXPECT_LT(of_smooth.refresh.value(), of_jagged.refresh.value());
  EXPECT_LT(of_smooth.warmup.value(), of_jagged.warmup.value());
  EXPECT_EQ(used_for("leather", "emulated").warmup, of_smooth.warmup) << "proposals move them as well";
}

TEST_F(SamplerRunTest, WhatTheUserAskedForIsUsedAndWrittenDown) {
  RunSettings told = settings();
  told.refresh = 0.4;
  told.warmup = 7;
  start_run(told, photo(), directory())->stop();
  EXPECT_EQ(read_manifest(directory()).settings.refresh, 0.4);
  EXPECT_EQ(read_manifest(directory()).settings.warmup, 7);
}

TEST_F(SamplerRunTest, MapOnlyFindsAMatchAndDrawsNothing) {
  RunSettings map_only = settings();
  map_only.map_only = true;
  const auto run = start(map_only);
  EXPECT_TRUE(draws_to_the_end(*run).empty());
  EXPECT_EQ(run->status().phase, RunPhase::finished);
  EXPECT_TRUE(run->status().best);
  EXPECT_FALSE(std::filesystem::exists(directory() / "chain-1.csv"));
}

TEST_F(SamplerRunTest, WhereTheSearchEndedIsWrittenDownTheBestFirst) {
  RunSettings asked = settings();
  asked.map_only = true;
  draws_to_the_end(*start(asked));
  const Manifest manifest = read_manifest(directory());
  ASSERT_FALSE(manifest.basins.empty());
  EXPECT_EQ(manifest.basins.front().values, manifest.map->values);
  for (const MapPoint& basin : manifest.basins) EXPECT_LE(basin.lp, manifest.map->lp);
}

TEST_F(SamplerRunTest, ABestPointIsShownWhileTheSearchGoesOn) {
  const auto run = start(with_a_long_search());
  bool early = false;
  EXPECT_TRUE(comes_true([&] {
    const RunStatus status = run->status();
    early |= status.phase == RunPhase::searching && status.best && status.search_fraction < 1;
    return early || status.phase > RunPhase::searching;
  }));
  EXPECT_TRUE(early);
}

TEST_F(SamplerRunTest, PauseHoldsTheDrawsAndResumeGoesOn) {
  const auto run = start(endless());
  ASSERT_TRUE(comes_true([&] { return run->status().phase == RunPhase::sampling; }));
  run->pause();
  EXPECT_EQ(run->status().phase, RunPhase::paused);
  run->take_draws();
  EXPECT_TRUE(comes_true([&] {
    std::this_thread::sleep_for(300ms);  // evaluations in flight end
    return run->take_draws().empty();
  }));
  EXPECT_EQ(run->status().draws_per_second, 0);
  run->resume();
  EXPECT_TRUE(comes_true([&] { return !run->take_draws().empty(); }));
  EXPECT_EQ(run->status().phase, RunPhase::sampling);
}

TEST_F(SamplerRunTest, PauseAndResumeChangeNoDraw) {
  draws_to_the_end(*start_run(settings(), photo(), folder_ / "a"));
  const auto run = start_run(settings(), photo(), folder_ / "b");
  while (!has_ended(*run)) {
    run->pause();
    std::this_thread::sleep_for(3ms);
    run->resume();
    std::this_thread::sleep_for(5ms);
  }
  EXPECT_EQ(without_times(folder_ / "b" / "chain-1.csv"), without_times(folder_ / "a" / "chain-1.csv"));
}

TEST_F(SamplerRunTest, StopEndsTheRunAndKeepsWhatWasDrawn) {
  const auto run = start(endless());
  ASSERT_TRUE(comes_true([&] { return run->status().phase == RunPhase::sampling; }));
  run->stop();
  const std::vector<Draw> draws = draws_to_the_end(*run);
  EXPECT_EQ(run->status().phase, RunPhase::stopped);
  std::size_t rows = 0;
  for (const char* name : {"chain-1.csv", "chain-2.csv"}) rows += rows_of(directory() / name).size();
  EXPECT_EQ(rows, draws.size());
}

TEST_F(SamplerRunTest, StopEndsASearchAndAPausedRun) {
  for (const bool paused : {false, true}) {
    const auto run = start_run(with_a_long_search(), photo(), folder_ / (paused ? "paused" : "searching"));
    ASSERT_TRUE(comes_true([&] { return run->status().phase == RunPhase::searching; }));
    if (paused) run->pause();
    run->stop();
    draws_to_the_end(*run);
    EXPECT_EQ(run->status().phase, RunPhase::stopped);
    const std::string message = run->status().message;
    EXPECT_TRUE(message.starts_with("stopped: ") && message.find("match") != message.npos) << message;
  }
}

TEST_F(SamplerRunTest, MayBeDestroyedAtAnyMoment) {
  for (const auto wait : {0ms, 30ms, 300ms, 1000ms}) {
    const auto run = start_run(endless(), photo(), folder_ / std::to_string(wait.count()));
    std::this_thread::sleep_for(wait);
  }
}

TEST_F(SamplerRunTest, WakesTheFrontEndForDrawsAndForTheEnd) {
  std::atomic<DrawSource*> shown{nullptr};
  std::atomic<bool> saw_draws{false}, saw_end{false};
  const auto run = start_run(settings(), photo(), directory(), [&] {
    const DrawSource* source = shown;
    if (source == nullptr) return;
    saw_draws = saw_draws || transitions(source->status()) > 0;
    saw_end = saw_end || has_ended(*source);
  });
  shown = run.get();
  EXPECT_TRUE(comes_true([&] { return saw_draws && saw_end; }));
}

TEST_F(SamplerRunTest, APhotoThatNothingCanBeComparedWithFailsTheRunWithAReason) {
  Photo photo = RunTest::photo();
  for (float& value : photo.image.pixels) value = NAN;
  const auto run = start_run(settings(), photo, directory());
  draws_to_the_end(*run);
  EXPECT_EQ(run->status().phase, RunPhase::failed);
  EXPECT_NE(run->status().message.find("comparable"), std::string::npos) << run->status().message;
}

}  // namespace
}  // namespace patina
