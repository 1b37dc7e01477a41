// What the bundled network's summary costs, one thread: the vector alone, and with its gradient by the image.
#include <ATen/Parallel.h>
#include <ATen/TensorOperators.h>
#include <ATen/core/grad_mode.h>
#include <ATen/ops/rand.h>
#include <benchmark/benchmark.h>

#include "engine/allocator.h"
#include "engine/summary/summary.h"

namespace patina {
namespace {

void summary(benchmark::State& state) {
  at::set_num_threads(1);
  const at::NoGradGuard no_grad;
  const auto summary = make_summary("gram", {});
  const at::Tensor image = at::rand({3, state.range(0), state.range(0)});
  for (auto _ : state) benchmark::DoNotOptimize((*summary)(image).data_ptr());
}

void summary_and_gradient(benchmark::State& state) {
  at::set_num_threads(1);
  const auto summary = make_summary("gram", {});
  const at::Tensor image = at::rand({3, state.range(0), state.range(0)});
  for (auto _ : state) {
    const at::Tensor leaf = image.detach().set_requires_grad(true);
    (*summary)(leaf).square().sum().backward();
    benchmark::DoNotOptimize(leaf.grad().data_ptr());
  }
}

BENCHMARK(summary)->Arg(128)->Arg(256)->Arg(512)->Unit(benchmark::kMillisecond);
BENCHMARK(summary_and_gradient)->Arg(128)->Arg(256)->Arg(512)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace patina

BENCHMARK_MAIN();
