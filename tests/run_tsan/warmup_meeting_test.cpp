// Built with ThreadSanitizer: a data race fails the test by itself.
#include "engine/run/warmup_meeting.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "engine/run/run_control.h"
#include "engine/sampling/ladder.h"

namespace patina {
namespace {

using namespace std::chrono_literals;

constexpr int kChains = 3;

LadderWindow result(int chain, int meeting) {
  Eigen::MatrixXd matrix(2, 20);
  for (int i = 0; i < 20; ++i)
    matrix.col(i) << std::sin(7 * i + chain), (meeting + 1) * std::cos(3 * i * chain);
  return {{1}, {{matrix, 0.1 * (chain + 1) + meeting, nullptr}}, {}};
}

TEST(WarmupMeeting, EveryChainLeavesEachMeetingWithWhatIsPooledOverAll) {
  constexpr int kMeetings = 50;
  WarmupMeeting meeting(kChains);
  const std::stop_source never;
  std::vector<std::jthread> chains;
  std::atomic<int> right{0};
  for (int k = 0; k < kChains; ++k)
    chains.emplace_back([&, k] {
      for (int m = 0; m < kMeetings; ++m) {
        std::vector<LadderWindow> all;
        for (int other = 0; other < kChains; ++other) all.push_back(result(other, m));
        if ((k + m) % 3 == 0) std::this_thread::sleep_for(100us);
        const KernelSettings pooled = meeting.meet(k, m, result(k, m), never.get_token()).rungs.front();
        const KernelSettings expected = pool(all, MetricKind::dense).rungs.front();
        right += pooled.metric->covariance() == expected.metric->covariance() &&
                 pooled.step_size == expected.step_size;
      }
    });
  chains.clear();
  EXPECT_EQ(right, kChains * kMeetings);
}

TEST(WarmupMeeting, AStopReleasesTheChainsThatWait) {
  WarmupMeeting meeting(kChains);
  std::stop_source stop;
  std::atomic<int> released{0};
  std::vector<std::jthread> chains;
  for (int k = 0; k + 1 < kChains; ++k)  // the last one never comes
    chains.emplace_back([&, k] {
      try {
        meeting.meet(k, 0, result(k, 0), stop.get_token());
      } catch (const RunStopped&) {
        ++released;
      }
    });
  std::this_thread::sleep_for(20ms);
  EXPECT_EQ(released, 0);
  stop.request_stop();
  chains.clear();
  EXPECT_EQ(released, kChains - 1);
}

}  // namespace
}  // namespace patina
