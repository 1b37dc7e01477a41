#pragma once

#include <ATen/Parallel.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace patina {

constexpr std::int64_t kBlock = 4096;  // pixels: enough to pay for a thread, few enough to add up in float32

inline std::int64_t blocks_of(std::int64_t count, std::int64_t size = kBlock) {
  return (count + size - 1) / size;
}

/// Calls f(block, begin, end) for each block of `size` pixels, or rows, on all of the thread's tensor
/// threads.
template <class F>
void over_blocks(std::int64_t count, std::int64_t size, const F& f) {
  at::parallel_for(0, blocks_of(count, size), 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t block = first; block < last; ++block)
      f(block, block * size, std::min(count, (block + 1) * size));
  });
}

template <class F>
void over_blocks(std::int64_t pixels, const F& f) {
  over_blocks(pixels, kBlock, f);
}

/// Of rows of `side` pixels, as many as come near kBlock.
inline std::int64_t rows_of_a_block(std::int64_t side) { return std::max<std::int64_t>(1, kBlock / side); }

/// Calls f(begin, end, sums) for each block of `size` pixels, or rows; f adds to `summed` sums of its
/// block's. A block's stand for themselves until all are done: the totals, which are returned, do not depend
/// on the threads.
template <class F>
std::vector<double> sums_over_blocks(std::int64_t count, std::int64_t size, std::size_t summed, const F& f) {
  std::vector<double> sums(static_cast<std::size_t>(blocks_of(count, size)) * summed), totals(summed);
  over_blocks(count, size, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    f(begin, end, sums.data() + static_cast<std::size_t>(block) * summed);
  });
  for (std::size_t i = 0; i < sums.size(); ++i) totals[i % summed] += sums[i];
  return totals;
}

template <class F>
std::vector<double> sums_over_blocks(std::int64_t pixels, std::size_t summed, const F& f) {
  return sums_over_blocks(pixels, kBlock, summed, f);
}

}  // namespace patina
