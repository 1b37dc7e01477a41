// What convergence figures cost while draws arrive: all of 23 parameters and lp, four chains. add: a draw;
// ask: one question to RunningSummary, as the window asks; exact: the same figures by the definitions.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "engine/diagnostics/convergence.h"
#include "engine/run/running_summary.h"
#include "engine/sampling/rng.h"

namespace patina {
namespace {

constexpr int kParameters = 23, kChains = 4;

ParameterTable table() {
  ParameterTable table;
  for (int i = 0; i < kParameters; ++i)
    table.continuous.push_back({"p" + std::to_string(i), "", "", {0, 1, -100, 100}});
  return table;
}

/// Chains of which every parameter is an autoregression, of correlation 0 to 0.99.
class Autoregressions {
 public:
  Autoregressions() {
    for (Draw& draw : now_) draw.values.continuous.assign(kParameters, 0);
  }
  const Draw& next() {
    Draw& draw = now_[turn_];
    draw.chain = static_cast<int>(turn_);
    turn_ = (turn_ + 1) % kChains;
    draw.lp = 0;
    for (int i = 0; i < kParameters; ++i) {
      double& x = draw.values.continuous[static_cast<std::size_t>(i)];
      const double r = 0.99 * i / (kParameters - 1);
      x = r * x + std::sqrt(1 - r * r) * rng_.normal();
      draw.lp -= 0.5 * x * x;
    }
    return draw;
  }

 private:
  Rng rng_{1};
  std::array<Draw, kChains> now_;
  std::size_t turn_ = 0;
};

RunSummary blank() {
  RunSummary summary;
  summary.quantities.resize(1 + kParameters);
  for (int k = 0; k < kChains; ++k) summary.chains.push_back({k, 0, 0, 0, 0});
  return summary;
}

RunningSummary after(std::int64_t draws) {
  RunningSummary running(table());
  Autoregressions chains;
  for (std::int64_t i = 0; i < draws; ++i) running.add(chains.next());
  return running;
}

void ask(benchmark::State& state) {
  const RunningSummary running = after(state.range(0));
  RunSummary summary = blank();
  for (auto _ : state) {
    running.update(summary);
    benchmark::DoNotOptimize(summary);
  }
  state.counters["bytes_a_draw"] = static_cast<double>(running.bytes()) / static_cast<double>(state.range(0));
  state.counters["raw_bytes_a_draw"] = sizeof(double) * kParameters;
}

/// All draws from none to so many, revisions of levels included.
void add(benchmark::State& state) {
  Autoregressions chains;
  std::vector<Draw> draws;
  for (std::int64_t i = 0; i < state.range(0) / 10; ++i) draws.push_back(chains.next());
  for (auto _ : state) {
    RunningSummary running(table());
    for (int repeat = 0; repeat < 10; ++repeat)
      for (const Draw& draw : draws) running.add(draw);
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

/// One quantity; 24 of them are a summary.
void exact(benchmark::State& state) {
  Rng rng(1);
  Eigen::MatrixXd draws(state.range(0) / kChains, kChains);
  for (double& value : draws.reshaped()) value = rng.normal();
  for (auto _ : state) {
    benchmark::DoNotOptimize(split_rhat(draws) + bulk_ess(draws) + tail_ess(draws));
    benchmark::DoNotOptimize(mcse_mean(draws));
  }
}

BENCHMARK(ask)->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(add)->Arg(1'000'000)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(exact)->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace patina

BENCHMARK_MAIN();
