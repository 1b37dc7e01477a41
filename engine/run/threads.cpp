#include "engine/run/threads.h"

#include <ATen/Parallel.h>

#include <algorithm>
#include <mutex>
#include <thread>

#include "engine/run/openblas.h"

namespace patina {
void use_tensor_threads(int count) {
  static std::once_flag once;
  std::call_once(once, prepare_openblas);
  at::set_num_threads(count);
}

int hardware_threads() { return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }

}  // namespace patina
