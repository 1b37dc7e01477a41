// What a kernel costs beside its evaluations: microseconds of processor time a transition in 23 dimensions,
// on N(0, I) in a dense metric, after warm-up; what that many evaluations take by themselves is subtracted.
//   bench-overhead --benchmark_repetitions=9 --benchmark_report_aggregates_only
#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "engine/sampling/kernels.h"
#include "engine/sampling/sample.h"

namespace patina {
namespace {

constexpr Eigen::Index kDimension = 23;

/// N(0, I), and levels that displace nothing.
class Cheap final : public LogDensity {
 public:
  Cheap(bool jagged, std::vector<int> levels) : levels_(std::move(levels)) {
    if (jagged) jagged_.resize(kDimension, false), jagged_.front() = true;
  }
  Eigen::Index dimension() const override { return kDimension; }
  std::vector<int> discrete_levels() const override { return levels_; }
  std::vector<bool> jagged() const override { return jagged_; }
  Evaluation evaluate(const Position& p) const override {
    Evaluation evaluation{-0.5 * p.continuous.squaredNorm(), -p.continuous};
    if (!jagged_.empty()) evaluation.gradient[0] = 0;
    return evaluation;
  }

 private:
  std::vector<int> levels_;
  std::vector<bool> jagged_;
};

/// Of this thread, on a processor.
double seconds() {
  timespec spent;
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &spent);
  return static_cast<double>(spent.tv_sec) + 1e-9 * static_cast<double>(spent.tv_nsec);
}

double seconds_of_an_evaluation(const LogDensity& target, const Position& position) {
  constexpr int kTimes = 20000;
  const double start = seconds();
  for (int i = 0; i < kTimes; ++i) benchmark::DoNotOptimize(target.evaluate(position));
  return (seconds() - start) / kTimes;
}

/// A bend of all other coordinates along the first, as a run's curved metric may have it.
std::shared_ptr<const Straightening> bend() {
  Straightening::Coefficients coefficients{Eigen::MatrixXd::Constant(5, kDimension, 0.1),
                                           Eigen::MatrixXd::Constant(5, kDimension, 0.05)};
  coefficients.middle.col(0).setZero();
  coefficients.log_width.col(0).setZero();
  return std::make_shared<const Straightening>(
      0, NaturalSplineBasis((Eigen::VectorXd(5) << -2, -1, 0, 1, 2).finished()), std::move(coefficients));
}

struct Setup {
  std::string kernel;
  double alpha = 1, refresh = 0;
  bool jagged = false, bent = false;
};

void overhead(benchmark::State& state, const Setup& setup) {
  const Cheap target(setup.jagged, setup.alpha < 1 ? std::vector<int>{3, 4} : std::vector<int>{});
  const auto kernel = make_kernel(setup.kernel, target, setup.alpha, setup.refresh);
  KernelSettings settings = sample(target, *kernel, {.chains = 2, .warmup = 600, .draws = 1}).frozen;
  if (setup.bent) settings.straightening = bend();
  Rng rng(1);
  ChainState chain{{rng.normals(kDimension), Eigen::VectorXi::Zero(std::ssize(target.discrete_levels()))},
                   {}};
  chain.evaluation = target.evaluate(chain.position);
  const double an_evaluation = seconds_of_an_evaluation(target, chain.position);
  double evaluations = 0, transitions = 0;
  const double start = seconds();
  for (auto _ : state) {
    evaluations += kernel->step(target, settings, chain, rng).evaluations;
    ++transitions;
  }
  const double beside = seconds() - start - evaluations * an_evaluation;
  state.counters["evaluations"] = evaluations / transitions;
  state.counters["overhead_us"] = 1e6 * beside / transitions;
  state.counters["per_evaluation_us"] = 1e6 * beside / std::max(evaluations, 1.0);
}

}  // namespace
}  // namespace patina

int main(int argc, char** argv) {
  using patina::Setup;
  const auto add = [](const std::string& name, const Setup& setup) {
    benchmark::RegisterBenchmark(name.c_str(), patina::overhead, setup)->MinTime(0.2);
  };
  for (const std::string& kernel : patina::kernel_names()) add(kernel, {kernel});
  add("hmc, refresh moves 0.75", {"hmc", 1, 0.75});
  add("hmc, refresh moves 0.75, a jagged coordinate", {"hmc", 1, 0.75, true});
  add("hmc, refresh moves 0.75, straightened", {"hmc", 1, 0.75, false, true});
  add("hmc, refresh moves 0.75, discrete moves 0.2", {"hmc", 0.8, 0.75});
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
