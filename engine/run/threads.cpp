#include "engine/run/threads.h"

#include <ATen/Parallel.h>
#include <dlfcn.h>

#include <algorithm>
#include <mutex>
#include <thread>

namespace patina {
namespace {

/// OpenBLAS has a pool of its own behind one lock: chains would queue for it. Other BLAS libraries lack the
/// function.
void keep_blas_single_threaded() {
  using SetThreads = void (*)(int);
  if (auto* symbol = ::dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))
    reinterpret_cast<SetThreads>(symbol)(1);
}

}  // namespace

void use_tensor_threads(int count) {
  static std::once_flag once;
  std::call_once(once, keep_blas_single_threaded);
  at::set_num_threads(count);
}

int hardware_threads() { return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }

}  // namespace patina
