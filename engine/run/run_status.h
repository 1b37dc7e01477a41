#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/material/parameter.h"
#include "engine/run/alarm.h"
#include "engine/run/run_settings.h"

namespace patina {

enum class RunPhase { starting, searching, warming_up, sampling, paused, finished, stopped, failed };

struct ChainStatus {
  std::int64_t iteration = 0;    ///< transitions made, warm-up included
  double acceptance = 0;         ///< mean over the draws after warm-up (over warm-up until there are any)
  std::int64_t divergences = 0;  ///< after warm-up
  double step_size = 0;
};

/// The newest state of a run, as a front end shows it. A value: copied out of the latest-value slot.
struct RunStatus {
  RunPhase phase = RunPhase::starting;
  std::string message;                  ///< one sentence: what it is doing now, or why it stopped
  double search_fraction = 0;           ///< 0..1 while searching
  double read_fraction = 1;             ///< of the draws in its directory, where it is read from there
  std::optional<ParameterValues> best;  ///< the best point found so far by the search; then the MAP
  double best_lp = 0;
  std::vector<ChainStatus> chains;
  std::string errors;           ///< in force, once they are known: Manifest::errors
  std::optional<int> warmup;    ///< likewise
  Alarms alarms;                ///< of the photo and its best match; those of the draws say summarize_draws()
  double draws_per_second = 0;  ///< all chains together, over the last few seconds
};

/// A run's settings with the errors and the warm-up that are in force, once they are known.
inline RunSettings in_force(RunSettings settings, const RunStatus& status) {
  if (!status.errors.empty()) settings.errors = status.errors;
  if (status.warmup) settings.warmup = status.warmup;
  return settings;
}

}  // namespace patina
