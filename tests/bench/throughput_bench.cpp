// How well a log density and its gradient use the machine: VGG-19's shapes with random weights, bump at 512
// pixels, all threads. The arithmetic of its convolutions, forward and back, in the seconds of a whole
// evaluation (render, Gram matrices and their gradients included) is held against what the
// library's convolution reaches on the shape that suits it best.
//   bench-throughput [REPEATS=5]
#include <ATen/core/Tensor.h>
#include <ATen/core/grad_mode.h>
#include <ATen/ops/randn.h>
#include <ATen/ops/zeros.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "engine/allocator.h"
#include "engine/io/temporary_folder.h"
#include "engine/material/renderer.h"
#include "engine/posterior/posterior.h"
#include "engine/run/threads.h"
#include "engine/summary/feature_steps.h"
#include "engine/summary/precision.h"
#include "tests/bench/random_vgg19.h"
#include "tests/bench/timing.h"

namespace patina {
namespace {

constexpr int kResolution = 512;
constexpr auto kChannelsLast = at::MemoryFormat::ChannelsLast;

/// Operations a second of the library's convolution, of that of VGG-19's large shapes that suits it best.
double best_throughput(Precision precision) {
  constexpr int kTimes = 8;
  const at::NoGradGuard no_grad;
  double best = 0;
  for (const ConvolutionShape& shape :
       {ConvolutionShape{64, 64, 512}, {128, 128, 256}, {256, 256, 128}, {512, 512, 64}}) {
    const at::Tensor weight = at::randn({shape.out, shape.in, 3, 3}).contiguous(kChannelsLast);
    const FrozenConvolution convolution(weight, at::zeros({shape.out}), /*relu=*/false, /*reflect=*/false,
                                        precision);
    const at::Tensor map = at::randn({1, shape.in, shape.side, shape.side}).contiguous(kChannelsLast);
    convolve(convolution, map);  // warms up
    const double spent = 1e-3 * milliseconds([&] {
                           for (int i = 0; i < kTimes; ++i) convolve(convolution, map);
                         });
    best = std::max(best, kTimes * shape.operations() / spent);
  }
  return best;
}

/// Seconds of an evaluation and operations a second, of each pair.
struct Pairs {
  std::vector<double> seconds, whole, plain, shares;
};

Pairs measure(const std::filesystem::path& network, const std::string& precision, int repeats) {
  const Renderer renderer("bump", 2, Capture{});
  PosteriorSettings settings;
  settings.resolution = kResolution;
  settings.network = network;
  settings.precision = precision;
  const Posterior target(settings, renderer.render(prior_location(renderer.table()), kResolution));
  const Position position = target.position(prior_location(target.table()));

  double operations = 0;
  for (const ConvolutionShape& shape : vgg19_shapes(kResolution)) operations += 2 * shape.operations();
  Pairs pairs;
  for (int i = -1; i < repeats; ++i) {  // the first to warm up
    const double plain = best_throughput(precision_named(precision));
    const double whole = 1e-3 * milliseconds([&] { target.evaluate(position); });
    if (i < 0) continue;
    pairs.seconds.push_back(whole);
    pairs.whole.push_back(operations / whole);
    pairs.plain.push_back(plain);
    pairs.shares.push_back(operations / whole / plain);
  }
  return pairs;
}

void report(int repeats) {
  use_tensor_threads(hardware_threads());
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "vgg19.safetensors";
  write_random_vgg19(file);
  std::printf("%d thread(s), medians of %d pairs\n", hardware_threads(), repeats);
  for (const std::string& precision : precision_names()) {
    if (precision == "bfloat16" && !bfloat16_pays()) {
      std::printf("bfloat16: no faster on this processor\n");
      continue;
    }
    const Pairs pairs = measure(file, precision, repeats);
    std::printf(
        "%s: convolutions alone %.0f GFLOP/s; log density and gradient, "
        "VGG-19 at %d pixels, %.2f s, %.0f GFLOP/s in convolutions: %.0f %%\n",
        precision.c_str(), median(pairs.plain) / 1e9, kResolution, median(pairs.seconds),
        median(pairs.whole) / 1e9, 100 * median(pairs.shares));
  }
}

}  // namespace
}  // namespace patina

int main(int argc, char** argv) { patina::report(argc > 1 ? std::max(1, std::atoi(argv[1])) : 5); }
