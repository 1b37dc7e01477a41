#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "engine/run/run_status.h"

namespace patina {

/// The phases as run.json spells them.
inline constexpr std::array<std::pair<RunPhase, std::string_view>, 8> kPhaseWords{{
    {RunPhase::starting, "starting"},
    {RunPhase::searching, "searching"},
    {RunPhase::warming_up, "warming_up"},
    {RunPhase::sampling, "sampling"},
    {RunPhase::paused, "paused"},
    {RunPhase::finished, "finished"},
    {RunPhase::stopped, "stopped"},
    {RunPhase::failed, "failed"},
}};

inline std::string phase_word(RunPhase phase) {
  for (const auto& [known, word] : kPhaseWords)
    if (known == phase) return std::string(word);
  return {};
}

/// Whether nothing more will come of a run in that phase.
constexpr bool has_ended(RunPhase phase) {
  return phase == RunPhase::finished || phase == RunPhase::stopped || phase == RunPhase::failed;
}

}  // namespace patina
