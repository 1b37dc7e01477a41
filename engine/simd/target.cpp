#include "engine/simd/target.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace patina::simd {
namespace {

Target highest() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("x86-64-v4")) return Target::v4;
  if (__builtin_cpu_supports("x86-64-v3")) return Target::v3;
#endif
  return Target::baseline;
}

Target wanted() {
  const char* named = std::getenv("PATINA_SIMD");
  const std::string_view name = named ? named : "";
  if (name == "baseline") return Target::baseline;
  return name == "v3" ? Target::v3 : Target::v4;
}

}  // namespace

Target target() {
  static const Target chosen = std::min(highest(), wanted());
  return chosen;
}

}  // namespace patina::simd
