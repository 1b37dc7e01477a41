#pragma once

#include <optional>

#include "engine/material/parameter.h"
#include "engine/run/alarm.h"
#include "engine/run/run_settings.h"
#include "engine/run/run_status.h"
#include "engine/run/summarize.h"

namespace patina {

/// What a run says against itself: of the photo and its best match (run_alarms()), of the draws
/// (draw_alarms()), and apart_alarm().
Alarms all_alarms(const RunSettings& settings, const ParameterTable& table, const RunStatus& status,
                  const RunSummary& summary);

/// "apart": after kApartDraws of each, chains still sit in places of their own, in a run given one draw of
/// the irregularities where the material has free jagged parameters: every place of its texture may then be a
/// match for itself. Errors that average over the irregularities have no such matches (resources/charts).
std::optional<Alarm> apart_alarm(const RunSettings& settings, const ParameterTable& table,
                                 const RunSummary& summary);

constexpr int kApartDraws = 500;
constexpr double kApartRhat = 1.05;

}  // namespace patina
