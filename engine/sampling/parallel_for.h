#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace patina {

/// Calls work(0) ... work(count - 1), each once, on up to `threads` threads of its own, and returns when all
/// are done. After a throw no further work is begun and the first exception is thrown here.
/// @param enter_thread  called first on each of those threads; may be empty
inline void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& work,
                         const std::function<void()>& enter_thread = {}) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  const auto run = [&] {
    if (enter_thread) enter_thread();
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        next = count;
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
      }
    }
  };
  {
    std::vector<std::jthread> pool;
    const std::size_t useful = std::min(count, static_cast<std::size_t>(std::max(threads, 1)));
    for (std::size_t i = 0; i < useful; ++i) pool.emplace_back(run);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace patina
