#pragma once

#include <string>
#include <vector>

#include "engine/posterior/emulate.h"
#include "engine/run/run_settings.h"
#include "engine/run/run_shared.h"

namespace patina {

/// The kernel of a run whose proposals come from an emulator (engine/posterior/emulator.h).
inline constexpr const char* kEmulated = "emulated";

/// Warm-up iterations that its chains take: transitions leave little of where they began.
constexpr int kEmulatedWarmup = 200;

/// kernel_names() and kEmulated.
std::vector<std::string> run_kernel_names();

/// @throws UserError for a run that asks for emulated proposals where there are none: with jagged coordinates
///                   or discrete levels, learnt errors, a ladder, chains that begin elsewhere
void check_can_emulate(const RunSettings& settings, const Posterior& posterior);

/// emulate() of a run, on all processors; keeps its status up to date.
/// @throws RunStopped   @throws UserError where polynomials do not follow the renders
Emulator learn_emulator(const Posterior& posterior, const Position& mode, const Metric& laplace,
                        std::uint64_t seed, RunShared& shared);

}  // namespace patina
