// Built with ThreadSanitizer: a data race fails the test by itself.
#include "engine/run/draw_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace patina {
namespace {

constexpr int kChains = 4;
constexpr int kDrawsPerChain = 20000;

Draw numbered(int chain, int iteration) {
  Draw draw;
  draw.chain = chain;
  draw.iteration = iteration;
  draw.values.continuous = {chain + 0.5, static_cast<double>(iteration)};
  return draw;
}

/// Everything that a consumer takes while producers push.
std::vector<Draw> taken_while_pushed(DrawQueue& queue) {
  std::vector<std::jthread> producers;
  std::atomic<int> running{kChains};
  for (int chain = 0; chain < kChains; ++chain)
    producers.emplace_back([&queue, &running, chain] {
      for (int i = 0; i < kDrawsPerChain; ++i) queue.push(numbered(chain, i));
      --running;
    });
  std::vector<Draw> taken;
  for (bool last = false; !last;) {
    last = running == 0;  // asked before the queue is emptied
    for (Draw& draw : queue.take_all()) taken.push_back(std::move(draw));
  }
  return taken;
}

TEST(DrawQueue, LosesNothingAndKeepsEachChainsOrder) {
  DrawQueue queue;
  std::vector<std::int64_t> next(kChains);
  for (const Draw& draw : taken_while_pushed(queue)) {
    ASSERT_EQ(draw.iteration, next[static_cast<std::size_t>(draw.chain)]++);
    ASSERT_EQ(draw.values.continuous,
              (std::vector<double>{draw.chain + 0.5, static_cast<double>(draw.iteration)}));
  }
  EXPECT_EQ(next, std::vector<std::int64_t>(kChains, kDrawsPerChain));
  EXPECT_TRUE(queue.take_all().empty());
}

}  // namespace
}  // namespace patina
