#include "engine/run/chain.h"

#include <utility>
#include <vector>

#include "engine/run/chain_start.h"
#include "engine/run/run_files.h"
#include "engine/run/state_file.h"
#include "engine/run/stopwatch.h"
#include "engine/run/threads.h"

namespace patina {
namespace {

ChainCsvHeader header_of(const ChainPlan& plan, int index) {
  ChainCsvHeader header;
  header.model = "patina_" + plan.settings.material;
  header.id = index + 1;
  header.seed = plan.settings.seed;
  header.num_warmup = plan.settings.warmup.value();
  header.num_samples = plan.settings.draws;
  header.names = column_names(plan.table);
  return header;
}

std::vector<double> metric_diagonal(const KernelSettings& settings) {
  const Eigen::VectorXd diagonal = settings.metric->covariance().diagonal();
  return {diagonal.begin(), diagonal.end()};
}

/// The number of the last window at whose end the chains met, of those before `window`; -1 for none.
int last_meeting(int warmup, int window) {
  const std::vector<WarmupWindow> schedule = warmup_schedule(warmup);
  for (int i = window - 1; i >= 0; --i)
    if (chains_meet(schedule[static_cast<std::size_t>(i)], warmup)) return i;
  return -1;
}

/// The file of a chain: taken up where it was, or begun.
ChainCsvWriter open_file(const ChainPlan& plan, int index, const ChainCheckpoint* saved) {
  const std::filesystem::path file = chain_file(plan.directory, index);
  if (saved == nullptr) return ChainCsvWriter(file, header_of(plan, index));
  return ChainCsvWriter(file, header_of(plan, index), saved->file);
}

}  // namespace

Chain::Chain(const ChainPlan& plan, WarmupMeeting& meeting, RunShared& shared, int index)
    : Chain(plan, meeting, shared, index,
            read_checkpoint(chain_state_file(plan.directory, index), plan.run_key, plan.target,
                            plan.settings)) {}

Chain::Chain(const ChainPlan& plan, WarmupMeeting& meeting, RunShared& shared, int index,
             std::optional<ChainCheckpoint> saved)
    : plan_(plan),
      meeting_(meeting),
      shared_(shared),
      index_(index),
      begun_(saved.has_value()),
      at_(saved.value_or(ChainCheckpoint{})),
      rng_(plan.settings.seed, static_cast<std::uint64_t>(index) + 1),
      file_(open_file(plan, index, begun_ ? &at_ : nullptr)) {
  if (!begun_) return;
  const int met = last_meeting(plan_.settings.warmup.value(), at_.window);
  if (met >= 0 && !meeting_.was_held(met))
    refuse_state(chain_state_file(plan_.directory, index_), "warmup.state is not the one that goes with it");
  rng_.seek(at_.random_position);
  recall_draws();
}

void Chain::recall_draws() {
  const std::filesystem::path file = chain_file(plan_.directory, index_);
  ChainCsvReader reader(file);
  const auto rows = reader.read_new();
  std::int64_t iteration = 0;
  for (const ChainCsvReader::Row& row : rows) {
    Draw draw = to_draw(row, plan_.table, index_, iteration++);
    tally_.add(draw);
    shared_.draws.push(std::move(draw));
  }
  const bool same = iteration == at_.iteration &&
                    (rows.empty() || rows.back().row.lp == at_.climber.on_target().evaluation.log_density);
  if (!same) refuse_state(chain_state_file(plan_.directory, index_), "it does not go with " + file.string());
  shared_.edit_status([&](RunStatus& status) { status.chains[index_] = tally_.status(); });
}

template <class Work>
void Chain::guarded(const Work& work) noexcept {
  try {
    use_tensor_threads(1);
    work();
  } catch (const RunStopped&) {
    // What was drawn so far is kept.
  } catch (const std::exception& error) {
    shared_.fail(error.what());
  }
}

void Chain::warm_up() noexcept {
  guarded([&] {
    if (!begun_) begin();
    go_through_windows();
  });
}

void Chain::sample(const Kernel& kernel) noexcept {
  kernel_ = &kernel;
  guarded([&] {
    shared_.control.checkpoint();  // where warm-up was stopped, there is nothing to go on from
    make_draws();
  });
  close();
}

void Chain::begin() {
  const Stopwatch stopwatch(at_.warmup_seconds);
  const auto start = [&](Rng& rng) {
    return plan_.start ? start_at(plan_.target, plan_.start, rng)
                       : overdispersed_start(plan_.target, plan_.mode, *plan_.laplace, rng);
  };
  const auto metric = std::make_shared<const Metric>(restricted(plan_.laplace->covariance(), plan_.metric));
  at_.climber = begin_climb(plan_.target, plan_.kernel, plan_.settings.rungs(), metric,
                            plan_.settings.warmup.value() > 0, start, rng_);
  begun_ = true;
}

void Chain::go_through_windows() {
  const std::vector<WarmupWindow> schedule = warmup_schedule(plan_.settings.warmup.value());
  while (at_.window < std::ssize(schedule)) {
    const WarmupWindow& window = schedule[static_cast<std::size_t>(at_.window)];
    while (at_.iteration < window.end) step(/*warmup=*/true);
    end_window(window);
  }
}

void Chain::end_window(const WarmupWindow& window) {
  save();  // others may let it wait
  Climber climber = at_.climber;
  LadderWindow result = take_window(climber);
  if (chains_meet(window, plan_.settings.warmup.value()))
    go_on_with(meeting_.meet(index_, at_.window, std::move(result), shared_.control.token()),
               window.adapts_metric, climber);
  at_.climber = std::move(climber);
  ++at_.window;
  save();
}

void Chain::make_draws() {
  shared_.edit_status([](RunStatus& status) {
    status.phase = RunPhase::sampling;
    status.message = "drawing samples";
  });
  const KernelSettings& frozen = at_.climber.target_settings();
  if (!file_.place().adapted)
    shared_.write_or_pause([&] { file_.adaptation_terminated(frozen.step_size, metric_diagonal(frozen)); });
  const std::int64_t last = std::int64_t{plan_.settings.warmup.value()} + plan_.settings.draws;
  while (at_.iteration < last) step(/*warmup=*/false);
}

/// All or nothing: a transition that is broken off has not begun.
void Chain::step(bool warmup) {
  shared_.control.checkpoint();  // a discrete move to the same level makes no evaluation
  const Stopwatch stopwatch(warmup ? at_.warmup_seconds : at_.sampling_seconds);
  Rng rng = rng_;
  ClimberStep step = next_step(plan_.target, *kernel_, at_.climber, rng);
  record(step, warmup);
  take_step(std::move(step), warmup, at_.climber);
  rng_ = rng;
  save_now_and_then();
}

void Chain::record(const ClimberStep& step, bool warmup) {
  const TransitionInfo& info = step.on_target;
  const ChainState& state = step.state.rungs.back();
  Draw draw;
  draw.chain = index_;
  draw.iteration = at_.iteration;
  draw.warmup = warmup;
  draw.lp = state.evaluation.log_density;
  draw.energy = info.energy;
  draw.accept_stat = info.accept_probability;
  draw.step_size = at_.climber.target_settings().step_size;
  draw.divergent = info.divergent;
  draw.values = plan_.values(state.position);
  const ChainCsvRow row = to_row(draw, info);
  shared_.write_or_pause([&] { file_.append(row); });

  ++at_.iteration;
  tally_.add(draw);
  shared_.draw_rate.count(1, RateMeter::Clock::now());
  shared_.draws.push(std::move(draw));
  shared_.edit_status([&](RunStatus& status) { status.chains[index_] = tally_.status(); });
}

void Chain::save_now_and_then() {
  if (Clock::now() - saved_ >= plan_.checkpoint_interval) save();
}

void Chain::save() {
  at_.random_position = rng_.position();
  at_.file = file_.place();
  shared_.write_or_pause([&] {
    file_.sync();  // a state must not reach the disk before the rows that it counts on
    write_checkpoint(chain_state_file(plan_.directory, index_), plan_.run_key, at_);
  });
  saved_ = Clock::now();
}

void Chain::close() noexcept {
  try {
    if (begun_) save();
    shared_.write_or_pause([&] { file_.close(); });
  } catch (const RunStopped&) {
    // The disk is full and the run is over: a chain file without its footer is still whole lines, and the
    // chain goes on from its last state but one.
  } catch (const std::exception& error) {
    shared_.fail(error.what());
  }
}

}  // namespace patina
