#include "engine/sampling/rng.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include "engine/sampling/philox.h"

namespace patina {
namespace {

std::uint32_t low(std::uint64_t word) { return static_cast<std::uint32_t>(word); }
std::uint32_t high(std::uint64_t word) { return static_cast<std::uint32_t>(word >> 32); }

/// Block `index` of a stream: the key is the seed, the counter's upper half the stream.
std::array<std::uint32_t, 4> random_block(std::uint64_t seed, std::uint64_t stream, std::uint64_t index) {
  return philox4x32({low(index), high(index), low(stream), high(stream)}, {low(seed), high(seed)});
}

}  // namespace

Rng::Rng(std::uint64_t seed, std::uint64_t stream)
    : seed_(seed), stream_(stream), block_(random_block(seed, stream, 0)) {}

Rng::result_type Rng::operator()() {
  const result_type word = block_[position_ % 4];
  if (++position_ % 4 == 0) block_ = random_block(seed_, stream_, position_ / 4);
  return word;
}

double Rng::uniform() {
  // 52 bits and a half: the middle of a cell is exact in a double, so neither 0 nor 1 can come out.
  const std::uint64_t upper = (*this)() >> 6;
  const std::uint64_t lower = (*this)() >> 6;
  return (static_cast<double>(upper << 26 | lower) + 0.5) * 0x1p-52;
}

double Rng::normal() {
  // Box-Muller, the sine half left unused: with no value held back, position() is the whole state.
  const double radius = std::sqrt(-2 * std::log(uniform()));
  return radius * std::cos(2 * std::numbers::pi * uniform());
}

int Rng::below(int n) {
  assert(n > 0);
  // Lemire 2019, "Fast random integer generation in an interval": reject the few words that would bias.
  const auto range = static_cast<std::uint32_t>(n);
  const std::uint32_t threshold = -range % range;
  std::uint64_t product;
  do product = std::uint64_t{(*this)()} * range;
  while (low(product) < threshold);
  return static_cast<int>(high(product));
}

Eigen::VectorXd Rng::normals(Eigen::Index n) {
  Eigen::VectorXd values(n);
  for (double& value : values) value = normal();
  return values;
}

std::uint64_t Rng::position() const { return position_; }

void Rng::seek(std::uint64_t position) {
  position_ = position;
  block_ = random_block(seed_, stream_, position_ / 4);
}

}  // namespace patina
