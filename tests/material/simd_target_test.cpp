#include "engine/simd/target.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace patina {
namespace {

/// So that tests that are run again with narrower vectors have them: tests/CMakeLists.txt names levels.
TEST(SimdTarget, IsTheLevelThatTheEnvironmentNamesOrTheHighestThatTheProcessorHas) {
  const char* named = std::getenv("PATINA_SIMD");
  const std::string name = named ? named : "";
  if (name == "baseline") {
    EXPECT_EQ(simd::target(), simd::Target::baseline);
    return;
  }
#if defined(__x86_64__)
  const bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const bool v4 = v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq");
  const simd::Target wanted = v4 && name != "v3" ? simd::Target::v4
                              : v3               ? simd::Target::v3
                                                 : simd::Target::baseline;
#else
  const simd::Target wanted = simd::Target::baseline;
#endif
  EXPECT_EQ(simd::target(), wanted);
}

}  // namespace
}  // namespace patina
