#include <atomic>
#include <chrono>
#include <random>
#include <thread>

#include "tests/cli/subprocess.h"
#include "tests/io/file_size_limit.h"
#include "tests/run/cheap_chains.h"

namespace patina {
namespace {

class DisturbedChains : public CheapChainsTest {};

TEST_F(DisturbedChains, InWhateverOrderThreadsGetTheirTurnsTheFilesAreTheSame) {
  const auto in_step = folder_ / "in step";
  take_up(in_step);
  for (unsigned seed = 1; seed <= 4; ++seed) {
    // A hiccup now and then, of one thread or another: which evaluations it hits is up to the scheduler.
    std::atomic<unsigned> count{seed};
    target_.before = [&] {
      std::minstd_rand random(++count);
      if (random() % 23 == 0) std::this_thread::sleep_for(std::chrono::microseconds(random() % 400));
    };
    const auto out_of_step = folder_ / std::to_string(seed);
    take_up(out_of_step);
    ASSERT_EQ(bytes_of(out_of_step), bytes_of(in_step)) << seed;
  }
}

TEST_F(DisturbedChains, AFullDiskPausesThemAndNoDrawIsLostOrChanged) {
  const auto undisturbed = folder_ / "a", disturbed = folder_ / "b";
  const std::size_t draws = take_up(undisturbed).size();
  RunShared shared({});
  std::atomic<bool> ended{false};
  std::jthread run;
  bool paused_again = false;
  {
    const FileSizeLimit limit(slurp(chain_file(undisturbed, 0)).size() / 2);
    run = std::jthread([&] {
      take_up(shared, disturbed);
      ended = true;
    });
    EXPECT_TRUE(comes_true([&] { return ended || shared.control.pause_reason().has_value(); }));
    shared.control.resume();  // too early
    paused_again = comes_true([&] { return ended || shared.control.pause_reason().has_value(); }) && !ended;
  }
  EXPECT_TRUE(paused_again);
  EXPECT_TRUE(comes_true([&] {
    shared.control.resume();
    return ended.load();
  }));
  shared.control.stop();
  run.join();
  EXPECT_EQ(shared.failure(), "");
  EXPECT_EQ(bytes_of(disturbed), bytes_of(undisturbed));
  EXPECT_EQ(shared.draws.take_all().size(), draws);
}

}  // namespace
}  // namespace patina
