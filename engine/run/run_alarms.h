#pragma once

#include <optional>
#include <vector>

#include "engine/image.h"
#include "engine/posterior/posterior.h"
#include "engine/run/alarm.h"

namespace patina {

/// What a run can say against itself before its first draw:
///   "dark", "burnt out", "blank", "off centre"  see photo_alarms()
///   "noise"   see noise_alarm()
///   "misfit"  see misfit_alarm()
/// Takes kNoiseRepeats evaluations.
Alarms run_alarms(const Image& photo, const Posterior& posterior, const Position& best);

constexpr int kNoiseRepeats = 20;

/// The best match is further from the photo than kFar times the error that the model is granted.
std::optional<Alarm> misfit_alarm(const std::vector<BlockMisfit>& misfits);

/// The granted errors are the average of the paper's own fits to its 14 photos; none of the nine that the
/// tests have is beyond so many times that average.
constexpr double kFar = 2.5;

}  // namespace patina
