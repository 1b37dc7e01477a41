#pragma once

#include <cstdint>

namespace patina {

/// A well-mixed 64-bit function of its argument (the finaliser of SplitMix64; Steele, Lea, Flood 2014).
constexpr std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// Uniform on [0, 1): a pure function of where it is asked for, so that no order of evaluation can change it.
constexpr double uniform_hash(std::uint64_t seed, std::uint64_t stream, std::uint64_t place) {
  return static_cast<double>(mix(mix(mix(seed) ^ stream) ^ place) >> 11) * 0x1p-53;
}

}  // namespace patina
