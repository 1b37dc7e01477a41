#pragma once

#include <memory>

#include "engine/sampling/archive.h"
#include "engine/sampling/chain_state.h"
#include "engine/sampling/ladder.h"

namespace patina {

// What the structs of a chain are made of, for a chain that is taken up again (see Archive). A field that is
// added to one of them is added here, and the format of state files counted up. Types with private fields
// have a member function instead: ChainWarmup, StepSizeAdaptation, SwapRecord.

void serialise(Archive& archive, Position& position);
void serialise(Archive& archive, Evaluation& evaluation);
void serialise(Archive& archive, ChainState& state);
void serialise(Archive& archive, KernelSettings& settings);
void serialise(Archive& archive, TemperedState& state);
void serialise(Archive& archive, LadderSettings& settings);

/// Its covariance; a null pointer is an empty one.
/// @throws ArchiveError for a covariance that no metric can have
void serialise(Archive& archive, std::shared_ptr<const Metric>& metric);

/// Lead, knots and coefficients; a null pointer has no knots.
/// @throws ArchiveError for what no map can have
void serialise(Archive& archive, std::shared_ptr<const Straightening>& map);

}  // namespace patina
