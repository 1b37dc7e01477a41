#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <future>
#include <stdexcept>

#include "gui/priority.h"

namespace patina {
namespace {

int niceness() { return ::getpriority(PRIO_PROCESS, static_cast<id_t>(::gettid())); }

TEST(Priority, OfThreadsThatAreStartedBehindFramesIsLowerAndTheCallersIsAsBefore) {
  const int before = niceness();
  const int started = behind_frames([] { return std::async(std::launch::async, niceness).get(); });
  EXPECT_GT(started, before);
  EXPECT_EQ(niceness(), before);
}

TEST(Priority, OfWhatAUserWaitsForIsBetweenFramesAndChains) {
  const auto niceness_after = [](void (*yield)()) {
    return std::async(std::launch::async, [=] { return yield(), niceness(); }).get();
  };
  EXPECT_GT(niceness_after(yield_to_frames), niceness());
  EXPECT_GT(niceness_after(yield_to_all), niceness_after(yield_to_frames));
}

TEST(Priority, LetsAFailureThrough) {
  EXPECT_THROW(behind_frames([]() -> int { throw std::runtime_error("no room"); }), std::runtime_error);
}

}  // namespace
}  // namespace patina
