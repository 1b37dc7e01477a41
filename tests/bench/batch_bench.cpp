// Whether several chains' renders should go through the network as one batch: the convolutions of the bundled
// network, there and back, on four maps at once by all threads, and one by one by as many threads, as chains
// do; and the same by one thread, as simulated photos go through it. Medians of interleaved repeats.
//   bench-batch [REPEATS=15]
#include <ATen/Parallel.h>
#include <ATen/TensorOperators.h>
#include <ATen/core/grad_mode.h>
#include <ATen/ops/mkldnn_convolution.h>
#include <ATen/ops/randn.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

#include "engine/allocator.h"
#include "tests/bench/timing.h"

namespace patina {
namespace {

constexpr int kChains = 4;
constexpr std::int64_t kKernel = 3;
constexpr auto kChannelsLast = at::MemoryFormat::ChannelsLast;

/// A convolution of 3 x 3, there and back, on a map whose side is the image's over `shrink`.
struct Layer {
  at::Tensor weight, back;
  std::int64_t in, out, shrink;
};

/// Those of resources/networks/bundled.safetensors.
std::vector<Layer> make_layers() {
  std::vector<Layer> layers;
  std::int64_t in = 3;
  const auto add = [&](std::int64_t out, std::int64_t shrink) {
    const at::Tensor weight = at::randn({out, in, kKernel, kKernel}) * 0.05;
    layers.push_back({weight, weight.flip({2, 3}).transpose(0, 1).contiguous(), in, out, shrink});
    in = out;
  };
  add(16, 1);
  add(32, 2);
  for (const std::int64_t shrink : {4, 8, 16})
    for (int i = 0; i < 2; ++i) add(shrink == 4 ? 48 : 64, shrink);
  return layers;
}

/// Maps and gradients of every layer, of one chain or of several.
struct Work {
  std::vector<at::Tensor> maps, gradients;

  Work(const std::vector<Layer>& layers, std::int64_t chains, std::int64_t side) {
    for (const Layer& layer : layers) {
      const std::int64_t n = side / layer.shrink;
      maps.push_back(at::randn({chains, layer.in, n, n}).contiguous(kChannelsLast));
      gradients.push_back(at::randn({chains, layer.out, n, n}).contiguous(kChannelsLast));
    }
  }

  void run(const std::vector<Layer>& layers) const {
    const at::NoGradGuard no_grad;
    const auto convolve = [](const at::Tensor& map, const at::Tensor& weight) {
      return at::mkldnn_convolution(map, weight, {}, {1, 1}, {1, 1}, {1, 1}, 1);
    };
    for (std::size_t i = 0; i < layers.size(); ++i) {
      convolve(maps[i], layers[i].weight);
      convolve(gradients[i], layers[i].back);
    }
  }
};

void report(std::int64_t side, int repeats) {
  constexpr int kRounds = 4;  // of every measurement, so that starting threads counts for little
  const std::vector<Layer> layers = make_layers();
  const Work batch(layers, kChains, side);
  std::vector<Work> chains;
  for (int i = 0; i < kChains; ++i) chains.emplace_back(layers, 1, side);
  const int threads = std::min(kChains, static_cast<int>(std::thread::hardware_concurrency()));
  const auto by_threads = [&](int count, const Work& work) {
    at::set_num_threads(count);
    for (int i = 0; i < kRounds; ++i) work.run(layers);
  };
  const auto apart = [&] {
    std::vector<std::jthread> pool;
    for (int t = 0; t < threads; ++t)
      pool.emplace_back([&, t] {
        at::set_num_threads(1);
        for (int i = 0; i < kRounds; ++i)
          for (int c = t; c < kChains; c += threads) chains[static_cast<std::size_t>(c)].run(layers);
      });
  };
  std::vector<double> batched, single, ratios, of_one_thread;
  for (int i = -1; i < repeats; ++i) {  // the first to warm up
    const double a = milliseconds([&] { by_threads(threads, batch); }) / kRounds,
                 b = milliseconds(apart) / kRounds;
    if (i < 0) continue;
    batched.push_back(a);
    single.push_back(b);
    ratios.push_back(a / b);
    of_one_thread.push_back(milliseconds([&] { by_threads(1, batch); }) / milliseconds([&] {
                              for (const Work& chain : chains) by_threads(1, chain);
                            }));
  }
  std::printf("| %d | %.2f | %.2f | %.2f | %.2f |\n", static_cast<int>(side), median(batched), median(single),
              median(ratios), median(of_one_thread));
}

}  // namespace
}  // namespace patina

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::max(1, std::atoi(argv[1])) : 15;
  std::puts("| pixels | one batch of 4, ms | 4 by themselves, ms | batch / by themselves | on one thread |");
  std::puts("|---|---|---|---|---|");
  for (const std::int64_t side : {32, 64, 128, 256}) patina::report(side, repeats);
}
