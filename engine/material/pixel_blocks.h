#pragma once

#include <ATen/Parallel.h>

#include <algorithm>
#include <cstdint>

namespace patina {

constexpr std::int64_t kBlock = 4096;  // pixels: enough to pay for a thread, few enough to add up in float32

inline std::int64_t blocks_of(std::int64_t pixels) { return (pixels + kBlock - 1) / kBlock; }

/// Calls f(block, begin, end) for each block of pixels, on all of the thread's tensor threads.
template <class F>
void over_blocks(std::int64_t pixels, const F& f) {
  at::parallel_for(0, blocks_of(pixels), 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t block = first; block < last; ++block)
      f(block, block * kBlock, std::min(pixels, (block + 1) * kBlock));
  });
}

}  // namespace patina
