#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <thread>

#include "engine/error.h"
#include "gui/material_finder.h"
#include "tests/support/comes_true.h"

namespace patina {
namespace {

/// A ranking that takes until it is told to end, or to stop.
class SlowRanking : public ::testing::Test {
 protected:
  std::optional<MaterialRanking> rank(const RankSettings& settings,
                                      const std::function<void(double, const std::string&)>& tell,
                                      const std::stop_token& stop) {
    ++begun_;
    tell(0.25, "looking for a match in leather");
    while (!stop.stop_requested() && !may_end_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ++ended_;
    if (stop.stop_requested()) return std::nullopt;
    if (settings.resolution == 0) throw UserError("Choose a larger resolution.");
    MaterialRanking ranking;
    ranking.summary = std::to_string(settings.resolution);
    return ranking;
  }

  void start(int resolution) {
    RankSettings settings;
    settings.resolution = resolution;
    finder_.start(std::make_shared<const Image>(8, 8, 3), settings);
  }

  std::atomic<int> begun_ = 0, ended_ = 0, wakes_ = 0;
  std::atomic<bool> may_end_ = false;
  MaterialFinder finder_{[this](const Image&, const RankSettings& settings, const auto& tell,
                                std::stop_token stop) { return rank(settings, tell, stop); },
                         [this] { ++wakes_; }};
};

TEST_F(SlowRanking, IsToldWhileItGoesOnAndTakenOnceWhenItIsDone) {
  start(64);
  ASSERT_TRUE(comes_true([&] { return finder_.progress().fraction == 0.25; }));
  EXPECT_EQ(finder_.progress().doing, "looking for a match in leather");
  EXPECT_TRUE(finder_.busy());
  EXPECT_FALSE(finder_.take());
  may_end_ = true;
  std::optional<MaterialRanking> ranking;
  ASSERT_TRUE(comes_true([&] { return (ranking = finder_.take()).has_value(); }));
  EXPECT_EQ(ranking->summary, "64");
  EXPECT_FALSE(finder_.busy());
  EXPECT_FALSE(finder_.take());
  EXPECT_GE(wakes_, 2) << "for the progress, and for the end";
}

TEST_F(SlowRanking, EndsSoonAfterItIsCancelledAndNothingComesOfIt) {
  start(64);
  ASSERT_TRUE(comes_true([&] { return begun_ == 1; }));
  finder_.cancel();
  EXPECT_FALSE(finder_.busy());
  ASSERT_TRUE(comes_true([&] { return ended_ == 1; }));
  for (int i = 0; i < 20; ++i, std::this_thread::sleep_for(std::chrono::milliseconds(1)))
    EXPECT_FALSE(finder_.take());
}

TEST_F(SlowRanking, GivesWayToTheNextOne) {
  start(64);
  ASSERT_TRUE(comes_true([&] { return begun_ == 1; }));
  start(96);
  may_end_ = true;
  std::optional<MaterialRanking> ranking;
  ASSERT_TRUE(comes_true([&] { return (ranking = finder_.take()).has_value(); }));
  EXPECT_EQ(ranking->summary, "96");
  EXPECT_EQ(begun_, 2);
}

TEST_F(SlowRanking, ThatFailsSaysWhy) {
  may_end_ = true;
  start(0);
  std::string refusal;
  ASSERT_TRUE(comes_true([&] {
    try {
      finder_.take();
    } catch (const UserError& error) {
      refusal = error.what();
    }
    return !refusal.empty();
  }));
  EXPECT_EQ(refusal, "Choose a larger resolution.");
}

}  // namespace
}  // namespace patina
