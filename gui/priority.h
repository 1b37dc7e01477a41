#pragma once

#include <concepts>
#include <future>
#include <type_traits>

namespace patina {

/// Lowers the calling thread's scheduling priority a little, and with it that of threads it starts later:
/// for what a user waits for, while frames go on.
void yield_to_frames();

/// Lowers it so far that frames, and what a user waits for, take all they want of a core: for chains.
void yield_to_all();

/// What start() returns, called on a thread that yields to all: threads that it starts do, too.
template <std::invocable Start>
std::invoke_result_t<Start> behind_frames(Start start) {
  return std::async(std::launch::async,
                    [&] {
                      yield_to_all();
                      return start();
                    })
      .get();
}

}  // namespace patina
