#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
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
/// @throws UserError for a run that asks for emulated proposals where there are none: with learnt errors, a
///                   ladder, chains that begin elsewhere, nothing but places of a texture free
bool emulates(const RunSettings& settings, const Posterior& posterior);

/// Where the chains begin that come along while an emulator learns: what the search ended in, best first, and
/// starts as chains have them.
std::vector<ChainState> emulator_starts(const LogDensity& target, const ChainState& mode,
                                        const std::vector<ChainState>& basins, const Metric& laplace,
                                        std::uint64_t seed, int threads,
                                        const std::function<void()>& enter_thread);

/// emulate() of a run, on all processors; keeps its status up to date. None where polynomials do not follow
/// the renders, or miss a basin, and the kernel is "auto".
/// @param basins  that the search ended in
/// @throws RunStopped   @throws UserError where they do so and the kernel is "emulated"
std::optional<Emulator> learn_emulator(const Posterior& posterior, const ChainState& mode,
                                       const Metric& laplace, const std::vector<MapPoint>& basins,
                                       const RunSettings& settings, RunShared& shared);

/// emulate_about() what the chains of a run have come to in warm-up, as their files have it.
/// @throws RunStopped   @throws UserError for a file that cannot be read
std::optional<Emulator> emulator_of_warmup(const Posterior& posterior, const ChainState& mode,
                                           const Metric& laplace, const std::filesystem::path& directory,
                                           const RunSettings& settings, RunShared& shared);

/// The kernel's name without "auto". @param emulated  whether there is an emulator
std::string kernel_in_use(const RunSettings& settings, bool emulated);

}  // namespace patina
