#include "engine/allocator.h"

#include <gtest/gtest.h>
#include <jemalloc/jemalloc.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace patina {
namespace {

constexpr std::size_t kMebibyte = 1 << 20;

/// Of memory that this process holds, in use or kept for later.
std::size_t resident_bytes() {
  std::uint64_t epoch = 1;
  std::size_t size = sizeof(epoch);
  ::mallctl("epoch", &epoch, &size, &epoch, size);  // statistics are as of now
  std::size_t bytes = 0;
  size = sizeof(bytes);
  EXPECT_EQ(::mallctl("stats.resident", &bytes, &size, nullptr, 0), 0);
  return bytes;
}

std::vector<void*> taken(std::size_t count, std::size_t bytes) {
  std::vector<void*> blocks(count);
  for (void*& block : blocks) {
    block = std::malloc(bytes);
    std::memset(block, 1, bytes);
  }
  return blocks;
}

void give_back(std::vector<void*> blocks) {
  for (void* block : blocks) std::free(block);
}

TEST(TheAllocator, IsJemallocWithTheProgramsOptions) {
  ssize_t decay = 0;
  std::size_t size = sizeof(decay);
  ASSERT_EQ(::mallctl("opt.dirty_decay_ms", &decay, &size, nullptr, 0), 0);
  EXPECT_EQ(decay, -1);
}

TEST(TheAllocator, KeepsWhatIsGivenBack) {
  give_back(taken(64, 4 * kMebibyte));
  EXPECT_GT(resident_bytes(), 200 * kMebibyte);
}

// With jemalloc's own lg_extent_max_active_fit, 6, the second half is new memory.
TEST(TheAllocator, TakesSmallBuffersFromWhatItKeepsOfLargeOnes) {
  give_back(taken(64, 4 * kMebibyte));
  const std::size_t kept = resident_bytes();
  const std::vector<void*> small = taken(1000, kMebibyte / 8);
  EXPECT_LT(resident_bytes(), kept + 20 * kMebibyte);
  give_back(small);
}

}  // namespace
}  // namespace patina
