#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/posterior/emulate.h"
#include "engine/run/manifest.h"
#include "engine/run/run_settings.h"
#include "engine/run/run_shared.h"

namespace patina {

/// kernel_names(), kEmulated and kAuto.
std::vector<std::string> run_kernel_names();

/// Whether a run is to look for an emulator: kernel "emulated", and "auto" where there may be one.
/// @throws UserError for a run that asks for emulated proposals where there are none: with jagged coordinates
///                   or discrete levels, learnt errors, a ladder, chains that begin elsewhere
bool emulates(const RunSettings& settings, const Posterior& posterior);

/// emulate() of a run, on all processors; keeps its status up to date. None where polynomials do not follow
/// the renders, or miss a basin, and the kernel is "auto".
/// @param basins  that the search ended in
/// @throws RunStopped   @throws UserError where they do so and the kernel is "emulated"
std::optional<Emulator> learn_emulator(const Posterior& posterior, const ChainState& mode,
                                       const Metric& laplace, const std::vector<MapPoint>& basins,
                                       const RunSettings& settings, RunShared& shared);

/// The kernel's name without "auto". @param emulated  whether there is an emulator
std::string kernel_in_use(const RunSettings& settings, bool emulated);

}  // namespace patina
