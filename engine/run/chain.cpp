#include "engine/run/chain.h"

#include <chrono>
#include <utility>
#include <vector>

#include "engine/run/chain_start.h"
#include "engine/run/run_files.h"
#include "engine/run/threads.h"

namespace patina {
namespace {

/// Adds the time until its end of life to a number of seconds, also when that end is an exception.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(Clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double& seconds_;
  Clock::time_point start_ = Clock::now();
};

ChainCsvHeader header_of(const ChainPlan& plan, int index) {
  ChainCsvHeader header;
  header.model = "patina_" + plan.settings.material;
  header.id = index + 1;
  header.seed = plan.settings.seed;
  header.num_warmup = plan.settings.warmup;
  header.num_samples = plan.settings.draws;
  header.names = column_names(plan.table);
  return header;
}

std::vector<double> metric_diagonal(const KernelSettings& settings) {
  const Eigen::VectorXd diagonal = settings.metric->covariance().diagonal();
  return {diagonal.begin(), diagonal.end()};
}

}  // namespace

Chain::Chain(const ChainPlan& plan, WarmupMeeting& meeting, RunShared& shared, int index)
    : plan_(plan),
      meeting_(meeting),
      shared_(shared),
      index_(index),
      rng_(plan.settings.seed, static_cast<std::uint64_t>(index) + 1),
      file_(chain_file(plan.directory, index), header_of(plan, index)) {}

void Chain::run() noexcept {
  try {
    use_tensor_threads(1);
    yield_to_the_window();
    sample();
  } catch (const RunStopped&) {
    // What was drawn so far is kept.
  } catch (const std::exception& error) {
    shared_.fail(error.what());
  }
  close();
}

void Chain::sample() {
  ChainState state = overdispersed_start(plan_.target, plan_.mode, *plan_.laplace, rng_);
  const KernelSettings settings = warm_up(state);
  shared_.edit_status([](RunStatus& status) {
    status.phase = RunPhase::sampling;
    status.message = "drawing samples";
  });
  const Stopwatch stopwatch(sampling_seconds_);
  shared_.write_or_pause([&] { file_.adaptation_terminated(settings.step_size, metric_diagonal(settings)); });
  for (int i = 0; i < plan_.settings.draws; ++i) step(settings, state, nullptr);
}

KernelSettings Chain::warm_up(ChainState& state) {
  const Stopwatch stopwatch(warmup_seconds_);
  KernelSettings start;
  start.metric = std::make_shared<const Metric>(
      restricted(plan_.laplace->covariance(), metric_kind(plan_.settings.metric)));
  if (plan_.settings.warmup > 0 && plan_.kernel.target_acceptance() > 0)
    start.step_size = initial_step_size(plan_.target, start, state, rng_);
  ChainWarmup warmup(start, plan_.kernel.target_acceptance());
  KernelSettings frozen = start;
  for (const WarmupWindow& window : warmup_schedule(plan_.settings.warmup)) {
    for (int i = window.begin; i < window.end; ++i) step(warmup.settings(), state, &warmup);
    WindowResult result = warmup.take_window();
    const bool last = window.end == plan_.settings.warmup;
    if (!window.adapts_metric && !last) continue;
    const KernelSettings pooled = meeting_.meet(index_, std::move(result), shared_.control.token());
    if (window.adapts_metric) warmup.restart(pooled);
    frozen = {pooled.step_size, warmup.settings().metric};
  }
  return frozen;
}

void Chain::step(const KernelSettings& settings, ChainState& state, ChainWarmup* warmup) {
  shared_.control.checkpoint();  // a discrete move to the same level makes no evaluation
  const TransitionInfo info = plan_.kernel.step(plan_.target, settings, state, rng_);
  record(settings, state, info, warmup != nullptr);
  if (warmup != nullptr) warmup->observe(state, info);
}

void Chain::record(const KernelSettings& settings, const ChainState& state, const TransitionInfo& info,
                   bool warmup) {
  Draw draw;
  draw.chain = index_;
  draw.iteration = iteration_++;
  draw.warmup = warmup;
  draw.lp = state.evaluation.log_density;
  draw.accept_stat = info.accept_probability;
  draw.step_size = settings.step_size;
  draw.divergent = info.divergent;
  draw.values = plan_.values(state.position);
  const ChainCsvRow row = to_row(draw, info);
  shared_.write_or_pause([&] { file_.append(row); });

  tally_.add(draw);
  shared_.draw_rate.count(1, RateMeter::Clock::now());
  shared_.draws.push(std::move(draw));
  shared_.edit_status([&](RunStatus& status) { status.chains[index_] = tally_.status(); });
}

void Chain::close() noexcept {
  try {
    shared_.write_or_pause([&] { file_.close(warmup_seconds_, sampling_seconds_); });
  } catch (const RunStopped&) {
    // The disk is full and the run is over: a chain file without its footer is still whole lines.
  } catch (const std::exception& error) {
    shared_.fail(error.what());
  }
}

}  // namespace patina
