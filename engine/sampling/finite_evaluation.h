#pragma once

#include "engine/sampling/log_density.h"

namespace patina {

/// target.evaluate(position), held to its contract: where the value or any part of the gradient is not
/// finite, the value is -infinity and the gradient zero. What the target throws passes through.
Evaluation evaluate_finite(const LogDensity& target, const Position& position);

/// The same of target.value(position), whose gradient may be empty.
Evaluation value_finite(const LogDensity& target, const Position& position);

}  // namespace patina
