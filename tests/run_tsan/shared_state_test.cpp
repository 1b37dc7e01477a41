// Built with ThreadSanitizer: a data race fails the test by itself.
#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "engine/run/latest_value.h"
#include "engine/run/rate_meter.h"
#include "engine/run/run_control.h"
#include "engine/run/run_shared.h"
#include "engine/run/waker.h"

namespace patina {
namespace {

using namespace std::chrono_literals;

template <typename Condition>
bool comes_true(Condition condition) {
  for (int i = 0; i < 2000; ++i, std::this_thread::sleep_for(5ms))
    if (condition()) return true;
  return false;
}

struct Pair {
  std::int64_t number = 0;
  std::vector<std::int64_t> copies = std::vector<std::int64_t>(50);
};

TEST(LatestValue, IsNeverTornAndNeverOlderThanBefore) {
  LatestValue<Pair> latest;
  std::jthread writer([&](const std::stop_token& stop) {
    for (std::int64_t i = 1; !stop.stop_requested(); ++i) latest.set({i, std::vector<std::int64_t>(50, i)});
  });
  std::int64_t before = 0;
  for (int look = 0; look < 20000; ++look) {
    const Pair seen = latest.get();
    ASSERT_GE(seen.number, before);
    for (const std::int64_t copy : seen.copies) ASSERT_EQ(copy, seen.number);
    before = seen.number;
  }
}

TEST(RunControl, APausedThreadWaitsAtItsNextCheckpointAndGoesOnWhenResumed) {
  RunControl control;
  std::atomic<int> passed{0};
  std::jthread worker([&] {
    try {
      for (;;) {
        control.checkpoint();
        ++passed;
      }
    } catch (const RunStopped&) {
    }
  });
  ASSERT_TRUE(comes_true([&] { return passed > 100; }));
  control.pause("paused");
  std::this_thread::sleep_for(20ms);
  const int when_paused = passed;
  std::this_thread::sleep_for(50ms);
  EXPECT_LE(passed, when_paused + 1);
  EXPECT_EQ(control.pause_reason(), "paused");
  control.resume();
  EXPECT_TRUE(comes_true([&] { return passed > when_paused + 100; }));
  control.stop();
}

TEST(RunControl, StopReleasesAPausedThread) {
  RunControl control;
  control.pause("the disk is full");
  std::atomic<bool> stopped{false};
  std::jthread worker([&] {
    try {
      control.checkpoint();
    } catch (const RunStopped&) {
      stopped = true;
    }
  });
  std::this_thread::sleep_for(10ms);
  EXPECT_FALSE(stopped);
  control.stop();
  EXPECT_TRUE(comes_true([&] { return stopped.load(); }));
}

TEST(RunControl, KeepsTheFirstReasonOfAPause) {
  RunControl control;
  control.pause("first");
  control.pause("second");
  EXPECT_EQ(control.pause_reason(), "first");
}

TEST(Waker, TellsOfTheLastNewsAndNotForEveryOne) {
  std::atomic<int> news{0}, calls{0}, seen{0};
  Waker waker([&] {
    ++calls;
    seen = news.load();
  });
  const auto start = std::chrono::steady_clock::now();
  std::vector<std::jthread> tellers;
  for (int k = 0; k < 3; ++k)
    tellers.emplace_back([&] {
      for (int i = 0; i < 5000; ++i) {
        ++news;
        waker.note();
      }
    });
  tellers.clear();
  EXPECT_TRUE(comes_true([&] { return seen == 15000; }));
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  EXPECT_LE(calls, 2 + elapsed / 16ms);
}

TEST(RunShared, StatusChangesOfSeveralThreadsAllArrive) {
  RunShared shared({});
  shared.edit_status([](RunStatus& status) { status.chains.resize(3); });
  std::vector<std::jthread> chains;
  for (std::size_t k = 0; k < 3; ++k)
    chains.emplace_back([&shared, k] {
      for (int i = 0; i < 2000; ++i)
        shared.edit_status([k](RunStatus& status) { ++status.chains[k].iteration; });
    });
  for (int look = 0; look < 500; ++look) ASSERT_EQ(shared.newest_status().chains.size(), 3u);
  chains.clear();
  for (const ChainStatus& chain : shared.newest_status().chains) EXPECT_EQ(chain.iteration, 2000);
}

TEST(RunShared, AFailedWritePausesWithItsReasonAndIsTriedAgainAfterResume) {
  RunShared shared({});
  std::atomic<bool> full{true};
  std::atomic<int> written{0};
  std::jthread writer([&] {
    shared.write_or_pause([&] {
      if (full) throw UserError("The disk is full.");
      ++written;
    });
  });
  ASSERT_TRUE(comes_true([&] { return shared.control.pause_reason() == "The disk is full."; }));
  shared.control.resume();  // too early: there is no room yet
  ASSERT_TRUE(comes_true([&] { return shared.control.pause_reason().has_value(); }));
  EXPECT_EQ(written, 0);
  full = false;
  shared.control.resume();
  writer.join();
  EXPECT_EQ(written, 1);
}

TEST(RateMeter, ASteadyStreamHasItsOwnRateAndAnEndedOneHasNone) {
  RateMeter meter;
  auto now = RateMeter::Clock::time_point(1000s);
  for (int i = 0; i < 1000; ++i, now += 10ms) meter.count(1, now);
  EXPECT_NEAR(meter.per_second(now), 100, 100 * 0.25 / 3);
  EXPECT_GT(meter.per_second(now + 1s), 0);
  EXPECT_EQ(meter.per_second(now + 4s), 0);
}

TEST(RateMeter, AStreamHasItsRateFromItsFirstSecondOnAlsoAfterASilence) {
  RateMeter meter;
  for (const auto begin : {1000s, 1060s}) {
    auto now = RateMeter::Clock::time_point(begin);
    EXPECT_EQ(meter.per_second(now), 0);
    for (int i = 0; i < 100; ++i, now += 10ms) meter.count(1, now);
    EXPECT_NEAR(meter.per_second(now), 100, 5);
  }
}

}  // namespace
}  // namespace patina
