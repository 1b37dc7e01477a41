#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "engine/io/chain_csv.h"
#include "engine/run/chain_tally.h"
#include "engine/run/run_settings.h"
#include "engine/run/run_shared.h"
#include "engine/run/warmup_meeting.h"
#include "engine/sampling/chain_state.h"
#include "engine/sampling/kernel.h"
#include "engine/sampling/rng.h"
#include "engine/sampling/warmup.h"

namespace patina {

/// What all chains of a run have in common; outlives them.
struct ChainPlan {
  const RunSettings& settings;
  const ParameterTable& table;
  const LogDensity& target;  ///< controlled: see ControlledDensity
  const Kernel& kernel;
  std::function<ParameterValues(const Position&)> values;  ///< from sampling coordinates
  ChainState mode;
  std::shared_ptr<const Metric> laplace;
  std::filesystem::path directory;
};

/// One chain, on a thread of its own: start, warm-up, sampling. Every transition becomes a row of the chain's
/// file, then a draw in the queue; a rejected proposal repeats the draw.
class Chain {
 public:
  /// Creates chain-K.csv, K = index + 1. @throws UserError
  Chain(const ChainPlan& plan, WarmupMeeting& meeting, RunShared& shared, int index);

  /// Returns when all draws are made or the run is stopped; a failure is left in `shared`. The file is closed
  /// in every case.
  void run() noexcept;

  std::int64_t draws_after_warmup() const { return tally_.draws_after_warmup(); }

 private:
  void sample();
  KernelSettings warm_up(ChainState& state);
  void step(const KernelSettings& settings, ChainState& state, ChainWarmup* warmup);
  void record(const KernelSettings& settings, const ChainState& state, const TransitionInfo& info,
              bool warmup);
  void close() noexcept;

  const ChainPlan& plan_;
  WarmupMeeting& meeting_;
  RunShared& shared_;
  int index_;
  Rng rng_;
  ChainCsvWriter file_;
  ChainTally tally_;
  std::int64_t iteration_ = 0;
  double warmup_seconds_ = 0, sampling_seconds_ = 0;
};

}  // namespace patina
