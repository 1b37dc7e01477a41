#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "engine/io/chain_csv.h"
#include "engine/run/chain_checkpoint.h"
#include "engine/run/chain_tally.h"
#include "engine/run/run_settings.h"
#include "engine/run/run_shared.h"
#include "engine/run/warmup_meeting.h"
#include "engine/sampling/climber.h"
#include "engine/sampling/kernel.h"
#include "engine/sampling/rng.h"

namespace patina {

/// What all chains of a run have in common; outlives them.
struct ChainPlan {
  const RunSettings& settings;
  const ParameterTable& table;
  const LogDensity& target;                                ///< controlled: see ControlledDensity
  const Kernel& kernel;                                    ///< of warm-up
  std::function<ParameterValues(const Position&)> values;  ///< from sampling coordinates
  ChainState mode;
  std::shared_ptr<const Metric> laplace;
  MetricKind metric;  ///< that chains share
  std::filesystem::path directory;
  std::string run_key = "-";  ///< of the run's state files
  std::chrono::milliseconds checkpoint_interval{2000};
  /// Where a chain starts; empty: see overdispersed_start().
  std::function<Position(Rng&)> start = {};
  /// The kernel of the draws, asked for once all chains are warm; empty: warm-up's. It outlives the chains.
  std::function<const Kernel&()> kernel_of_draws = {};
};

/// One chain, on a thread of its own: start, warm-up, sampling; alone or on a ladder, of which the target's
/// rung is the chain that others see. Every transition becomes a row of the chain's file, then a draw in the
/// queue; a rejected proposal repeats the draw. Its state is written down every few seconds, at the end of
/// every window and of the run.
class Chain {
 public:
  /// Goes on from chain-K.state, K = index + 1, if there is one: chain-K.csv is cut to what it held then, and
  /// the draws in it are queued. Else begins chain-K.csv. Either way its further rows are the same.
  /// @throws UserError for a state or a chain file that is damaged or belongs to another run
  Chain(const ChainPlan& plan, WarmupMeeting& meeting, RunShared& shared, int index);

  /// Returns at the end of warm-up, at once where the chain has come further, or when the run is stopped; a
  /// failure is left in `shared`.
  void warm_up() noexcept;
  /// Returns when all draws are made or the run is stopped, likewise. The file is closed in every case.
  /// @param kernel  outlives the chain
  void sample(const Kernel& kernel) noexcept;

  std::int64_t draws_after_warmup() const { return tally_.draws_after_warmup(); }
  double warmup_seconds() const { return at_.warmup_seconds; }  ///< once sample() has returned
  double sampling_seconds() const { return at_.sampling_seconds; }

 private:
  using Clock = std::chrono::steady_clock;

  Chain(const ChainPlan& plan, WarmupMeeting& meeting, RunShared& shared, int index,
        std::optional<ChainCheckpoint> saved);
  void recall_draws();
  void begin();
  /// On a thread of its own: leaves a failure in `shared`.
  template <class Work>
  void guarded(const Work& work) noexcept;
  void go_through_windows();
  void end_window(const WarmupWindow& window);
  void make_draws();
  void step(bool warmup);
  void record(const ClimberStep& step, bool warmup);
  void save();
  void save_now_and_then();
  void close() noexcept;

  const ChainPlan& plan_;
  const Kernel* kernel_ = &plan_.kernel;
  WarmupMeeting& meeting_;
  RunShared& shared_;
  int index_;
  bool begun_;  ///< at_ is a place to go on from
  ChainCheckpoint at_;
  Rng rng_;
  ChainCsvWriter file_;
  ChainTally tally_;
  Clock::time_point saved_ = Clock::now();
};

}  // namespace patina
