#pragma once

#include <cstdint>
#include <string>

#include "engine/run/run_settings.h"
#include "engine/run/summarize.h"

namespace patina {

/// What a run that stops by its draws' quality is judged by: the worst figures of its identified parameters
/// and lp (see is_judged()), and whose they are.
struct StopEvidence {
  std::int64_t draws = 0;       ///< after warm-up, all chains
  std::string least_ess_of;     ///< empty: there was nothing to judge
  double least_ess = 0;         ///< the smaller of bulk and tail
  std::string largest_rhat_of;  ///< empty: there was nothing to judge
  double largest_rhat = 0;
  bool operator==(const StopEvidence&) const = default;
};

StopEvidence stop_evidence(const RunSummary& summary);

/// Whether all that the rules ask of the draws' quality is reached; false where they ask nothing.
bool is_reached(const StopRules& rules, const StopEvidence& evidence);

/// Whether it is reached with something to spare, so that the draws which are made until every chain has
/// heard of it do not undo it: then `summarize` says of the run what it said itself.
bool is_safely_reached(const StopRules& rules, const StopEvidence& evidence);

/// "the goal is reached: the fewest effective draws are 412 (rough; 400 asked for)": only what the rules ask.
std::string in_words(const StopRules& rules, const StopEvidence& evidence);

}  // namespace patina
