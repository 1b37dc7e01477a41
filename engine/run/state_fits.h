#pragma once

#include <memory>
#include <vector>

#include "engine/sampling/ladder.h"

namespace patina {

// Whether what was read from a state file can belong to a target: sizes, levels, numbers that are finite.

bool fits(const Position& position, const LogDensity& target);
bool fits(const ChainState& state, const LogDensity& target);
bool fits(const std::shared_ptr<const Metric>& metric, const LogDensity& target);
bool fits(const KernelSettings& settings, const LogDensity& target);

// What belongs to a ladder of so many rungs; one: a chain by itself.

bool fits(const std::vector<double>& betas, int rungs);
bool fits(const TemperedState& state, const LogDensity& target, int rungs);
bool fits(const std::vector<ChainWarmup>& warmups, const LogDensity& target, int rungs);
bool fits(const LadderSettings& settings, const LogDensity& target, int rungs);

}  // namespace patina
