#pragma once

/// What a kernel calls must become part of it: a call for each vector would cost more than its arithmetic.
#define PATINA_INLINE [[gnu::always_inline]] inline

/// Returns baseline::call, v3::call or v4::call (each_target.h), whichever suits simd::target().
#if defined(__x86_64__)
#define PATINA_ON_TARGET(call)           \
  switch (patina::simd::target()) {      \
    case patina::simd::Target::v4:       \
      return v4::call;                   \
    case patina::simd::Target::v3:       \
      return v3::call;                   \
    case patina::simd::Target::baseline: \
      break;                             \
  }                                      \
  return baseline::call
#else
#define PATINA_ON_TARGET(call) return baseline::call
#endif

namespace patina::simd {

/// Levels of the x86-64 psABI: vectors of 4, 8 (AVX2) and 16 (AVX-512) numbers. Elsewhere there is only the
/// first.
enum class Target { baseline, v3, v4 };

/// The highest that the processor has, or a lower one named by the environment variable PATINA_SIMD
/// ("baseline", "v3"), for tests and benchmarks.
Target target();

}  // namespace patina::simd
