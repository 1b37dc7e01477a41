#pragma once

#include <optional>
#include <string>

#include "engine/run/run_settings.h"
#include "engine/run/run_status.h"
#include "engine/run/stop_rules.h"

namespace patina {

/// How far a run is, and how long it still takes, as far as its rules to stop and its draws so far tell.
struct RunOutlook {
  enum class End {
    warmup,  ///< only of warm-up is known when it ends
    goal,    ///< the draws are good enough
    draws,   ///< all draws are made
    time     ///< the time that the run was given is over
  };
  float done = 0;                 ///< from 0 to 1, of the phase that the run is in
  std::optional<double> seconds;  ///< until `end`; none: not known
  End end = End::draws;
  bool at_most = false;  ///< the goal may be reached before, but when cannot be told yet
};

/// @param evidence  of the draws after warm-up, once there are enough to be judged
/// @param spent     seconds since this sitting began, which is what a limit of time counts; none: not known
RunOutlook run_outlook(const RunStatus& status, const RunSettings& settings,
                       const std::optional<StopEvidence>& evidence, std::optional<double> spent);

/// "About 3 minutes to go, until the draws are good enough"; what can be said where that is not known.
std::string outlook_text(const RunOutlook& outlook);

/// "a few seconds", "about 40 seconds", "about 3 minutes", "about 2 hours": as much as a guess deserves.
std::string duration_text(double seconds);

/// How far the chains agree and what they are worth, in words with the figures beside.
std::string agreement_text(const StopEvidence& evidence);

}  // namespace patina
