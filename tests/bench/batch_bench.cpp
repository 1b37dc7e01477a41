// Whether several chains' renders should go through the network as one batch: Gram matrices and their
// gradient of four images at once by all threads, and one by one by as many threads, as chains do; and the
// same by one thread, as simulated photos go through it. Medians of interleaved repeats.
//   bench-batch [--network bundled|vgg19] [--device cpu|cuda] [--precision float32|bfloat16] [--repeats N]
//   [RESOLUTION]...
#include <ATen/Parallel.h>
#include <ATen/TensorOperators.h>
#include <ATen/ops/rand.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "engine/allocator.h"
#include "engine/io/temporary_folder.h"
#include "engine/summary/summary.h"
#include "tests/bench/random_vgg19.h"
#include "tests/bench/timing.h"

namespace patina {
namespace {

constexpr int kChains = 4;

void there_and_back(const Summary& summary, const at::Tensor& images) {
  const at::Tensor leaf = images.detach().set_requires_grad(true);
  summary.of(leaf).square().sum().backward();
}

void report(const Summary& summary, int side, int repeats) {
  // Of every measurement, so that what a new thread has to make counts for little.
  constexpr int kRounds = 20;
  const at::Tensor images = at::rand({kChains, 3, side, side});
  const int threads = std::min(kChains, static_cast<int>(std::thread::hardware_concurrency()));
  const auto batch = [&](int count) {
    at::set_num_threads(count);
    for (int i = 0; i < kRounds; ++i) there_and_back(summary, images);
  };
  const auto one_by_one = [&](int first, int step) {
    at::set_num_threads(1);
    for (int i = 0; i < kRounds; ++i)
      for (int c = first; c < kChains; c += step) there_and_back(summary, images.narrow(0, c, 1));
  };
  const auto apart = [&] {
    std::vector<std::jthread> pool;
    for (int t = 0; t < threads; ++t) pool.emplace_back([&, t] { one_by_one(t, threads); });
  };
  std::vector<double> batched, single, ratios, of_one_thread;
  for (int i = -1; i < repeats; ++i) {  // the first to warm up
    const double a = milliseconds([&] { batch(threads); }) / kRounds, b = milliseconds(apart) / kRounds;
    const double c = milliseconds([&] { batch(1); }) / milliseconds([&] { one_by_one(0, 1); });
    if (i < 0) continue;
    batched.push_back(a);
    single.push_back(b);
    ratios.push_back(a / b);
    of_one_thread.push_back(c);
  }
  std::printf("| %d | %.2f | %.2f | %.2f | %.2f |\n", side, median(batched), median(single), median(ratios),
              median(of_one_thread));
  std::fflush(stdout);
}

}  // namespace
}  // namespace patina

int main(int argc, char** argv) {
  std::string network = "bundled", device = "cpu", precision = "float32";
  int repeats = 7;
  std::vector<int> sides{32, 64, 128, 256};
  CLI::App app("Several chains as one batch");
  app.add_option("--network", network)->check(CLI::IsMember({"bundled", "vgg19"}));
  app.add_option("--device", device)->check(CLI::IsMember(patina::device_names()));
  app.add_option("--precision", precision)->check(CLI::IsMember(patina::precision_names()));
  app.add_option("--repeats", repeats)->check(CLI::Range(1, 1000));
  app.add_option("RESOLUTION", sides)->check(CLI::Range(16, 1024));
  CLI11_PARSE(app, argc, argv);
  const patina::TemporaryFolder folder;
  std::filesystem::path file;
  if (network == "vgg19") patina::write_random_vgg19(file = folder.path() / "vgg19.safetensors");
  const auto summary =
      patina::make_summary("gram", file, patina::precision_named(precision), patina::device_named(device));
  std::puts("| pixels | one batch of 4, ms | 4 by themselves, ms | batch / by themselves | on one thread |");
  std::puts("|---|---|---|---|---|");
  for (const int side : sides) patina::report(*summary, side, repeats);
}
