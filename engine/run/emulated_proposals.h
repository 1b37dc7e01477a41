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
/// of twice as many starts as chains have them, about each basin as_good() as the best (on a rough
/// likeness of the target, which costs less, and then climbed on the target), those that lie furthest apart,
/// in Laplace's sds. What none begins in,
/// polynomials may never learn of: an end of leather_6's posterior, power above .4, they thought 7 to 43 nats
/// too little of where no start lay there, by three of four seeds, and half a nat where one did.
/// @param rough  of fewer pixels, say, or the target itself
std::vector<ChainState> emulator_starts(const LogDensity& rough, const LogDensity& target,
                                        const ChainState& mode, const std::vector<ChainState>& basins,
                                        const Metric& laplace, std::uint64_t seed, int threads,
                                        const std::function<void()>& enter_thread);

/// Of what a search ended in, what an average may be learnt about at once: the best, and what no valley parts
/// from it that is too deep for polynomials (wood_3 has a match whose rings are narrower than a pixel, two
/// nats behind the best and a valley of 400 to 600 away: learnt about both, chains stayed where they were).
/// @param target  whose values count   @return  best first
std::vector<ChainState> followed_together(const LogDensity& target, std::vector<ChainState> ends);

/// Nats below the best within which an average is learnt about a basin as much: climbs leave jagged
/// coordinates where they were (an image of wood_3's match ended 8 behind where a tenth of the draws lie).
constexpr double kAsGoodOnceWalked = 12;

/// emulate() of a run, on all processors; keeps its status up to date. No emulator where polynomials do not
/// follow the renders, or miss a basin, and the kernel is "auto".
/// @param rough   the posterior of fewer pixels, or itself
/// @param basins  that the search ended in
/// @throws RunStopped   @throws UserError where they do so and the kernel is "emulated"
Emulation learn_emulator(const Posterior& rough, const Posterior& posterior, const ChainState& mode,
                         const Metric& laplace, const std::vector<MapPoint>& basins,
                         const RunSettings& settings, RunShared& shared);

/// emulate_average() of a run, likewise. None where polynomials do not follow the renders.
/// @param posterior  by the photo's errors alone, with the run's own irregularities
/// @throws RunStopped   @throws UserError where they do not and the kernel is "emulated"
std::optional<AveragedEmulator> learn_average(const Posterior& rough, const Posterior& posterior,
                                              IrregularityPool& others, const Position& mode,
                                              const Metric& laplace, const std::vector<MapPoint>& basins,
                                              const RunSettings& settings, RunShared& shared);

/// Iterations of warm-up that chains have at most: of an average, whose covariance is known, for each learns
/// its step from dozens of transitions; and of a smooth target whose renders are emulated (with 250 or 500 an
/// emulator of bump_3 that is learnt again has as many of its proposals taken).
constexpr int kAveragedWarmup = 30, kEmulatedWarmup = 250;

/// An iteration of a chain.
struct ChainIteration {
  int chain = 0;
  std::size_t iteration = 0;
};

/// Where chains moved to in warm-up: what to learn from again, in order of time, so that of the last ones
/// each chain has its part. The first ones, too: they may have led through tails that chains have left since.
/// @param log_densities  of each chain's iterations of warm-up
std::vector<ChainIteration> moves_of_warmup(const std::vector<std::vector<double>>& log_densities);

/// emulate_about() what the chains of a run have come to in warm-up, as their files have it.
/// @param known  what warm-up's emulator has learnt from
/// @throws RunStopped   @throws UserError for a file that cannot be read
Emulator emulator_of_warmup(const Posterior& posterior, const KnownResiduals& known, const ChainState& mode,
                            const Metric& laplace, const std::filesystem::path& directory,
                            const RunSettings& settings, RunShared& shared);

/// The kernel's name without "auto". @param emulated  whether there is an emulator
std::string kernel_in_use(const RunSettings& settings, bool emulated);

/// The kind of metric that chains share: no curved one where there is an emulator. Its proposals are not
/// straightened, and the covariance that a curved metric has is of straightened coordinates: by it steps were
/// a quarter as long as by that of their own.
/// @param asked  for by who runs them
MetricKind metric_in_use(MetricKind asked, bool emulated);

}  // namespace patina
