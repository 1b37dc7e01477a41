#include "engine/run/openblas.h"

#include <dlfcn.h>

#include <cstdlib>
#include <string_view>

#include "engine/simd/target.h"

namespace patina {
namespace {

template <class Function>
Function* find(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_DEFAULT, name));
}

/// OpenBLAS's name for a processor of that level; null for the oldest.
const char* core_of(simd::Target target) {
  if (target == simd::Target::baseline) return nullptr;
  return target == simd::Target::v4 ? "SkylakeX" : "Haswell";
}

void use_the_processor() {
  constexpr const char* kCore = "OPENBLAS_CORETYPE";
  const auto core_name = find<char*()>("openblas_get_corename");
  const auto quit = find<void()>("gotoblas_dynamic_quit"), init = find<void()>("gotoblas_dynamic_init");
  const char* core = core_of(simd::target());
  if (!core_name || !quit || !init || !core || std::getenv(kCore)) return;
  if (std::string_view(core_name()) != "Prescott") return;
  ::setenv(kCore, core, 0);
  quit();
  init();
}

}  // namespace

void prepare_openblas() {
  if (const auto set_threads = find<void(int)>("openblas_set_num_threads")) set_threads(1);
  use_the_processor();
}

}  // namespace patina
