#include "tests/io/file_size_limit.h"
#include "tests/run/run_fixture.h"

namespace patina {
namespace {

class FullDisk : public RunTest {};

TEST_F(FullDisk, PausesTheRunWithASentenceAndNoDrawIsLostOrChanged) {
  RunSettings asked = settings();
  asked.draws = 300;  // it is not at its end before the disk is full, however late this thread gets its turn
  draws_to_the_end(*start_run(asked, photo(), folder_ / "undisturbed"));
  const auto run = start(asked);
  ASSERT_TRUE(comes_true([&] { return std::filesystem::exists(directory() / "chain-2.csv"); }));
  {
    const FileSizeLimit limit(10'000);  // some 50 rows
    ASSERT_TRUE(comes_true([&] { return run->status().phase == RunPhase::paused; }));
    EXPECT_NE(run->status().message.find("disk is full"), std::string::npos) << run->status().message;
    run->resume();  // too early: it pauses again
    ASSERT_TRUE(comes_true([&] { return run->status().phase == RunPhase::paused; }));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    for (const char* name : {"chain-1.csv", "chain-2.csv"}) EXPECT_EQ(slurp(directory() / name).back(), '\n');
  }
  EXPECT_TRUE(comes_true([&] {
    run->resume();
    return has_ended(*run);
  }));
  EXPECT_EQ(run->status().phase, RunPhase::finished);
  EXPECT_EQ(run->take_draws().size(), 2u * (40 + 300));
  for (const char* name : {"chain-1.csv", "chain-2.csv"})
    EXPECT_EQ(rows_of(directory() / name), rows_of(folder_ / "undisturbed" / name));
}

TEST_F(FullDisk, DoesNotKeepARunFromBeingStopped) {
  const auto run = start(endless());
  ASSERT_TRUE(comes_true([&] { return std::filesystem::exists(directory() / "chain-2.csv"); }));
  const FileSizeLimit limit(10'000);
  ASSERT_TRUE(comes_true([&] { return run->status().phase == RunPhase::paused; }));
  run->stop();
  draws_to_the_end(*run);
  EXPECT_EQ(run->status().phase, RunPhase::stopped);
}

}  // namespace
}  // namespace patina
