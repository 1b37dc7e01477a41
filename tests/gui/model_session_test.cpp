#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <map>
#include <random>
#include <thread>

#include "engine/error.h"
#include "engine/material/registry.h"
#include "gui/advice.h"
#include "gui/preview/shown_draw.h"
#include "gui/session.h"
#include "tests/gui/fake_source.h"
#include "tests/gui/session_fixture.h"

namespace patina {
namespace {

using testing::draw_at;
using testing::SessionTest;

TEST_F(SessionTest, NeedsAPhotoToStart) {
  EXPECT_THROW(session_.start(), UserError);
  EXPECT_FALSE(session_.has_run());
}

TEST_F(SessionTest, StartsARunOfTheChosenMaterialInADirectoryNamedAfterThePhoto) {
  session_.open(photo_);
  session_.choices().set_material("leather");
  session_.start();
  EXPECT_EQ(started_.material, "leather");
  const auto directory = session_.run().directory();
  EXPECT_EQ(directory.parent_path(), folder_.path() / "runs");
  EXPECT_TRUE(directory.filename().string().starts_with("oak door-leather-")) << directory;
}

TEST_F(SessionTest, GoesOnFromADrawWithEveryChainInsideWhatIsAssumedNow) {
  session_.open(photo_);
  RunChoices& choices = session_.choices();
  const ParameterTable& table = choices.table();
  ParameterValues values = prior_location(table);
  const std::size_t rough = *table.find_continuous("rough");
  values.continuous[rough] = 0.9;
  choices.set_prior("rough", {0.3, 0.1, 0.2, 0.4}, true);
  choices.lock("light", 1000);
  session_.start_at(values);
  EXPECT_EQ(started_.start, "values");
  EXPECT_LT(started_.start_at.at("rough"), 0.4);
  EXPECT_GT(started_.start_at.at("rough"), 0.399);
  EXPECT_EQ(started_.start_at.at("albedo_r"), values.continuous[*table.find_continuous("albedo_r")]);
  EXPECT_EQ(started_.fixed.at("light"), 1000);
  session_.start();
  EXPECT_EQ(started_.start, "map") << "to start afresh forgets it";
}

TEST_F(SessionTest, TellsWhichParameterThePhotoLeavesOpen) {
  session_.open(photo_);
  session_.start();
  // The prior of both is N(0.5, 0.2): the draws of rough are spread like it, those of fsigma much less.
  std::mt19937 rng(3);
  std::normal_distribution<double> normal;
  int made = 0;
  const auto feed = [&](int count) {
    std::vector<Draw> draws;
    for (int i = 0; i < count; ++i, ++made) {
      draws.push_back(draw_at(std::clamp(0.5 + 0.2 * normal(rng), 0.0, 1.0), 0.5 + 0.02 * normal(rng), 0,
                              false, made % 4));
      draws.back().iteration = made / 4;
    }
    run_->feed(draws);
  };
  const auto judged = [&](std::int64_t draws) {
    session_.poll();
    return session_.summary() && session_.summary()->chains.front().draws == draws / 4;
  };
  const auto wait = [&](std::int64_t draws) {
    for (int i = 0; i < 1500 && !judged(draws); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return judged(draws);
  };
  const auto held = [&] { return frozen_by(advice_for_next_run(session_)); };
  feed(40);
  ASSERT_TRUE(wait(40));
  EXPECT_TRUE(held().empty()) << "too few draws to say so";
  feed(1160);
  ASSERT_TRUE(wait(1200));
  ASSERT_EQ(held().size(), 1u);
  const double value = held().at("rough");
  EXPECT_NEAR(value, 0.5, 5 * 0.2 / std::sqrt(1200));
  EXPECT_EQ(holdable_text(advice_for_next_run(session_)), "The photo leaves open: Roughness");
  session_.choices().set_material("leather");
  EXPECT_TRUE(advice_for_next_run(session_).empty()) << "of another material nothing is known";
  session_.choices().undo();

  run_->status.best = prior_location(session_.choices().table());
  run_->status.best_lp = 1;
  session_.poll();
  const int steps = static_cast<int>(session_.choices().steps());
  session_.hold_and_go_on(held());
  EXPECT_EQ(started_.fixed, (std::map<std::string, double>{{"rough", value}}));
  EXPECT_EQ(started_.start, "values");
  EXPECT_EQ(session_.choices().steps(), steps + 1);
  EXPECT_TRUE(advice_for_next_run(session_).empty()) << "the new run has to draw first";
}

TEST_F(SessionTest, GoesOnInTheDirectoryOfARunThatEnded) {
  session_.open(photo_);
  session_.start();
  run_->status.phase = RunPhase::sampling;
  session_.poll();
  EXPECT_FALSE(session_.can_go_on());
  const auto directory = session_.run().directory();
  const std::int64_t all = session_.run().settings().warmup.value() + started_.draws;
  run_->status.phase = RunPhase::finished;
  run_->status.chains = {{.iteration = 100}, {.iteration = all}};
  session_.poll();
  ASSERT_TRUE(session_.can_go_on());
  session_.go_on();
  EXPECT_EQ(session_.run().directory(), directory);
  EXPECT_EQ(resumed_->draws, started_.draws) << "one chain has draws to make";
  EXPECT_EQ(resumed_->stop.rhat, 0);
  EXPECT_EQ(resumed_->stop.minutes, started_.stop.minutes);

  run_->status.chains = {{.iteration = all}};
  session_.poll();
  session_.go_on();
  EXPECT_EQ(resumed_->draws, 2 * started_.draws);
}

TEST_F(SessionTest, GoesOnWithARunOfAnotherProgramOnceThatHasEndedAndSelectsTheSameDraw) {
  std::ofstream(folder_.path() / "run.json") << "{}";
  run_->status.phase = RunPhase::sampling;
  session_.open(folder_.path());
  const auto fed = [](double x, int chain, std::int64_t iteration) {
    Draw draw = draw_at(x, 0.5, -x, false, chain);
    draw.iteration = iteration;
    return draw;
  };
  run_->feed({fed(0.1, 0, 7), fed(0.2, 1, 7), fed(0.3, 0, 8)});
  session_.poll();
  EXPECT_FALSE(session_.can_go_on()) << "the other program makes it";
  EXPECT_FALSE(session_.seconds_spent());
  run_->status.phase = RunPhase::stopped;
  session_.poll();
  ASSERT_TRUE(session_.can_go_on());
  ExplorerModel& model = session_.model();
  model.set_axes(testing::kY, testing::kCells);
  model.select(1);
  model.toggle_star(2);
  model.mark(model.inside(testing::kX, testing::kY, std::vector<PlotPlace>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}),
             Marking::replace);
  session_.go_on();
  EXPECT_TRUE(resumed_);
  EXPECT_TRUE(session_.seconds_spent());
  EXPECT_FALSE(session_.choices_wait());
  EXPECT_EQ(session_.model().draws().size(), 0u);
  run_->feed({fed(0.1, 0, 7), fed(0.3, 0, 8)});
  session_.poll();
  EXPECT_FALSE(session_.model().selected()) << "not there yet";
  EXPECT_TRUE(session_.model().marked().empty());
  EXPECT_TRUE(session_.model().starred(1));
  run_->feed({fed(0.2, 1, 7)});
  session_.poll();
  EXPECT_EQ(session_.model().selected(), 2u);
  EXPECT_EQ(session_.model().x_axis(), testing::kY);
}

TEST_F(SessionTest, TakesInEveryDrawOnce) {
  session_.open(photo_);
  session_.start();
  for (int i = 0; i < 10; ++i) {
    run_->feed({draw_at(0.1 * i, 0.5, -i), draw_at(0.1 * i, 0.6, -i)});
    session_.poll();
    session_.poll();
  }
  EXPECT_EQ(session_.model().draws().size(), 20u);
}

TEST_F(SessionTest, KeepsEverythingWhenSomethingCannotBeOpenedOrStarted) {
  session_.open(photo_);
  session_.start();
  run_->feed({draw_at(0.1, 0.5, -1)});
  session_.poll();
  const auto* run = &session_.run();
  const int versions = session_.run_version() + session_.photo_version();
  std::ofstream(folder_.path() / "notes.txt") << "not a picture";
  refuse_ = true;
  EXPECT_THROW(session_.open(folder_.path() / "notes.txt"), UserError);
  EXPECT_THROW(session_.open(folder_.path()), UserError);
  EXPECT_THROW(session_.choices().set_material("unobtainium"), UserError);
  EXPECT_THROW(session_.start(), UserError);
  EXPECT_EQ(&session_.run(), run);
  EXPECT_EQ(session_.model().draws().size(), 1u);
  EXPECT_EQ(session_.run_version() + session_.photo_version(), versions);
  EXPECT_EQ(session_.settings().material, "bump");
}

TEST_F(SessionTest, OpensARunDirectoryWithItsPhoto) {
  std::ofstream(folder_.path() / "run.json") << "{}";
  session_.open(folder_.path());
  EXPECT_TRUE(session_.has_run());
  EXPECT_EQ(session_.photo().image.width, 40);
  EXPECT_EQ(session_.photo_name(), folder_.path().filename());
}

TEST_F(SessionTest, ResizingTheSampleKeepsTheFieldOfView) {
  const Capture before = session_.settings().capture;
  session_.choices().set_size_cm(10);
  EXPECT_EQ(session_.settings().capture.size_cm, 10);
  EXPECT_DOUBLE_EQ(session_.settings().capture.camera_cm / 10, before.camera_cm / before.size_cm);
}

TEST_F(SessionTest, ShowsTypicalThenSearchThenBestThenSelected) {
  EXPECT_EQ(shown_draw(session_).kind, ShownDraw::Kind::typical);
  EXPECT_EQ(shown_draw(session_).values, prior_location(material_table("bump")));
  session_.open(photo_);
  session_.start();
  run_->status.best = ParameterValues{{0.4, 0.4}, {1}};
  run_->status.best_lp = -5;
  run_->feed({draw_at(0.1, 0.5, -7)});
  session_.poll();
  EXPECT_EQ(shown_draw(session_).kind, ShownDraw::Kind::search);
  EXPECT_EQ(shown_draw(session_).values, *run_->status.best);
  run_->feed({draw_at(0.2, 0.5, -3), draw_at(0.3, 0.5, -4)});
  session_.poll();
  EXPECT_EQ(shown_draw(session_).kind, ShownDraw::Kind::best);
  EXPECT_EQ(shown_draw(session_).draw, 1u);
  session_.model().select(2);
  EXPECT_EQ(shown_draw(session_).kind, ShownDraw::Kind::selected);
  EXPECT_EQ(shown_draw(session_).values, (ParameterValues{{0.3, 0.5}, {0}}));
}

TEST_F(SessionTest, SummarisesLiveWhatSummarizeDrawsSays) {
  session_.open(photo_);
  session_.start();
  std::vector<Draw> draws;
  for (int i = 0; i < 400; ++i) {
    draws.push_back(draw_at(0.5 + 0.4 * std::sin(7.0 * i), 0.5 + 0.3 * std::cos(3.0 * i), -0.01 * (i % 17),
                            i < 80, i % 4));
    draws.back().iteration = i / 4;
  }
  run_->feed(draws);
  for (int wait = 0; wait < 1000 && !session_.summary(); ++wait) {
    session_.poll();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ASSERT_TRUE(session_.summary());
  draws.erase(draws.begin(), draws.begin() + 80);
  const RunSummary expected = summarize_draws(testing::small_table(), draws);
  ASSERT_EQ(session_.summary()->quantities.size(), expected.quantities.size());
  for (std::size_t i = 0; i < expected.quantities.size(); ++i) {
    EXPECT_DOUBLE_EQ(session_.summary()->quantities[i].mean, expected.quantities[i].mean);
    EXPECT_DOUBLE_EQ(session_.summary()->quantities[i].sd, expected.quantities[i].sd);
  }
}

TEST_F(SessionTest, SummarisesAllOfMoreDrawsThanItKeeps) {
  session_.open(photo_);
  session_.start();
  constexpr int kDraws = 60000, kBatch = 20000;
  static_assert(kDraws > static_cast<int>(SummaryWorker::kMaxDraws));
  double sum = 0;
  for (int i = 0; i < kDraws; i += kBatch) {
    std::vector<Draw> draws;
    for (int j = i; j < i + kBatch; ++j) {
      const double x = 0.5 + 0.4 * std::sin(7.0 * j) + 1e-6 * j;
      sum += x;
      draws.push_back(draw_at(x, 0.5, 0, false, j % 4));
      draws.back().iteration = j / 4;
    }
    run_->feed(draws);
    session_.poll();
  }
  const auto counted = [&] {
    std::int64_t draws = 0;
    if (session_.summary())
      for (const ChainSummary& chain : session_.summary()->chains) draws += chain.draws;
    return draws;
  };
  for (int wait = 0; wait < 3000 && counted() < kDraws; ++wait) {
    session_.poll();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ASSERT_EQ(counted(), kDraws);
  EXPECT_NEAR(session_.summary()->quantities[1].mean, sum / kDraws, 1e-12);
}

}  // namespace
}  // namespace patina
