#pragma once

#include <memory>

#include "engine/sampling/chain_state.h"

namespace patina {

// Whether what was read from a state file can belong to a target: sizes, levels, numbers that are finite.

bool fits(const Position& position, const LogDensity& target);
bool fits(const ChainState& state, const LogDensity& target);
bool fits(const std::shared_ptr<const Metric>& metric, const LogDensity& target);
bool fits(const KernelSettings& settings, const LogDensity& target);

}  // namespace patina
