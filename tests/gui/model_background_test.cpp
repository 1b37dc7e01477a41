#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

#include "engine/error.h"
#include "gui/background_source.h"
#include "tests/gui/fake_source.h"
#include "tests/support/comes_true.h"

namespace patina {
namespace {

using testing::draw_at;

/// A run of a million draws in small: portions, then nothing more, or an error.
class Portions final : public DrawSource {
 public:
  explicit Portions(int portions, bool fails = false) : left_(portions), fails_(fails) {}

  const std::filesystem::path& directory() const override { return directory_; }
  const RunSettings& settings() const override { return settings_; }
  const ParameterTable& table() const override { return table_; }
  const Image& photo() const override { return photo_; }
  std::vector<Draw> take_draws() override {
    if (left_ > 0)
      return --left_, settings_.draws += 1, std::vector<Draw>(kPortion, draw_at(0.1, 0.2, left_));
    if (fails_) throw UserError("The chain file is damaged.");
    return {};
  }
  RunStatus status() const override {
    RunStatus status;
    status.phase = RunPhase::finished;
    status.read_fraction = left_ > 0 ? 0.5 : 1;
    return status;
  }
  bool can_control() const override { return false; }
  void pause() override {}
  void resume() override {}
  void stop() override {}

  static constexpr std::size_t kPortion = 10;

 private:
  int left_;
  bool fails_;
  std::filesystem::path directory_ = "run";
  RunSettings settings_;
  ParameterTable table_ = testing::small_table();
  Image photo_{8, 8, 3};
};

TEST(BackgroundSource, HandsOnEveryDrawAPortionAtATimeAndThenSaysThatAllIsRead) {
  BackgroundSource source(std::make_unique<Portions>(20), {});
  EXPECT_EQ(source.status().read_fraction, 0.5);
  EXPECT_EQ(source.table().continuous.size(), 2u);
  std::size_t draws = 0;
  ASSERT_TRUE(comes_true([&] {
    const std::size_t portion = source.take_draws().size();
    EXPECT_LE(portion, Portions::kPortion) << "a window takes in one portion a frame";
    draws += portion;
    return source.status().read_fraction == 1;
  }));
  EXPECT_EQ(draws, 20 * Portions::kPortion);
  EXPECT_EQ(source.settings().draws, RunSettings().draws + 20) << "a run that goes on may be asked for more";
}

TEST(BackgroundSource, ReadsNoFurtherAheadThanAPortionWhileNobodyTakes) {
  std::atomic<int> wakes = 0;
  BackgroundSource source(std::make_unique<Portions>(1000), [&] { ++wakes; });
  ASSERT_TRUE(comes_true([&] { return wakes > 0; }));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_EQ(wakes, 1);
}

TEST(BackgroundSource, ThrowsWhatTheSourceThrewOnceAndAfterItsDraws) {
  BackgroundSource source(std::make_unique<Portions>(1, true), {});
  std::size_t draws = 0;
  std::string refusal;
  ASSERT_TRUE(comes_true([&] {
    try {
      draws += source.take_draws().size();
    } catch (const UserError& error) {
      refusal = error.what();
    }
    return !refusal.empty();
  }));
  EXPECT_EQ(draws, Portions::kPortion);
  EXPECT_EQ(refusal, "The chain file is damaged.");
  EXPECT_TRUE(source.take_draws().empty());
}

TEST(BackgroundSource, LetsTheWindowSleepOnceAllIsRead) {
  std::atomic<int> wakes = 0;
  BackgroundSource source(std::make_unique<Portions>(3), [&] { ++wakes; });
  ASSERT_TRUE(comes_true([&] { return source.take_draws(), source.status().read_fraction == 1; }));
  const int before = wakes;
  for (int i = 0; i < 50; ++i) {
    source.take_draws();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_EQ(wakes, before);
}

}  // namespace
}  // namespace patina
