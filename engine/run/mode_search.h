#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "engine/posterior/emulator.h"
#include "engine/posterior/known_residuals.h"
#include "engine/posterior/posterior.h"
#include "engine/posterior/vetted_density.h"
#include "engine/posterior/wider_errors.h"
#include "engine/run/calibrated_errors.h"
#include "engine/run/chain.h"
#include "engine/run/manifest.h"
#include "engine/run/run_shared.h"
#include "engine/sampling/map_search.h"

namespace patina {

/// The same posterior from coarse to fine: 128, 256 ... pixels a side, then the resolution itself.
std::vector<int> pyramid(int resolution);

/// An average is learnt about all matches that are about as good: of leather_4's ridge of height and power
/// each search ended elsewhere, and a run drew from what lay about that end.
MapSearchSettings search_before_average();

/// What the search hands to the chains.
struct ModeFound {
  ChainState mode;
  std::shared_ptr<const Metric> laplace;        ///< covariance of the normal approximation at the mode
  std::vector<MapPoint> basins = {};            ///< that the search ended in, best first; empty when recalled
  std::optional<CalibratedErrors> errors = {};  ///< of calibrated errors: mode and covariance are under them
  std::optional<WiderErrors> wider = {};        ///< of widened errors, likewise
  bool has_tried_to_emulate = false;            ///< where there are to be emulated proposals
  std::optional<Emulator> emulator = {};        ///< of these
  std::optional<AveragedEmulator> average = {};  ///< in its place, of widened errors: what is drawn from
  std::optional<KnownResiduals> known = {};  ///< that it was learnt from; not kept, learnt anew when recalled
  bool has_learnt_again = false;             ///< what warm-up has come to; the emulator is of that then
};

/// Looks for matches on the pyramid, coarse first, and keeps the status up to date with the best point so
/// far.
/// @param posteriors  one per level of the pyramid
/// @param keep        called with that point as it becomes better, by any thread, one at a time
/// @param guesses     where it looks first; with RunSettings::start "predict" almost only there
/// @param average_follows  over irregularities, learnt about what is found
/// @throws RunStopped
MapSearchResult find_matches(const std::vector<std::unique_ptr<Posterior>>& posteriors,
                             const RunSettings& settings, const std::vector<Position>& guesses,
                             bool average_follows, RunShared& shared,
                             const std::function<void(const MapPoint& best)>& keep);

/// What a search ended in, as it is written down.
std::vector<MapPoint> basins_of(const Posterior& posterior, const std::vector<OptimizerResult>& found);

/// What a search ended in, as chains want it: with Laplace's covariance at the best.
/// @param found      on the posterior, at least one basin, best first
/// @throws RunStopped
ModeFound mode_of(const Posterior& posterior, const std::vector<OptimizerResult>& found, RunShared& shared);

}  // namespace patina
