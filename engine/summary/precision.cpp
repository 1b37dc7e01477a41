#include "engine/summary/precision.h"

#include <ATen/TensorOperators.h>
#include <ATen/core/grad_mode.h>
#include <ATen/ops/ones.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <limits>

#include "engine/error.h"
#include "engine/summary/feature_steps.h"

namespace patina {
namespace {

/// Of a convolution there and back; the fastest of several, which other programs disturb least.
double seconds(Precision precision) {
  constexpr std::int64_t kChannels = 64, kSide = 96;
  constexpr int kTimes = 5;
  const FrozenConvolution convolution(at::ones({kChannels, kChannels, 3, 3}), at::ones({kChannels}),
                                      /*relu=*/true, /*reflect=*/true, precision);
  const at::Tensor map = at::ones({1, kChannels, kSide, kSide}).set_requires_grad(true);
  double fastest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kTimes; ++i) {
    const auto start = std::chrono::steady_clock::now();
    convolve(convolution, map).sum().backward();
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    fastest = std::min(fastest, spent.count());
  }
  return fastest;
}

}  // namespace

std::vector<std::string> precision_names() { return {"float32", "bfloat16"}; }

Precision precision_named(const std::string& name) {
  if (name == "float32") return Precision::float32;
  if (name == "bfloat16") return Precision::bfloat16;
  throw UserError("There is no precision '" + name + "': use float32 or bfloat16.");
}

bool bfloat16_pays() {
  constexpr double kWorthwhile = 0.75;
  static const bool pays = [] {
    try {
      const at::AutoGradMode record(true);
      return seconds(Precision::bfloat16) < kWorthwhile * seconds(Precision::float32);
    } catch (const std::exception&) {  // the library has no such convolution for this processor
      return false;
    }
  }();
  return pays;
}

}  // namespace patina
