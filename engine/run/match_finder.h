#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "engine/image.h"
#include "engine/posterior/irregularity_pool.h"
#include "engine/posterior/photo_fit.h"
#include "engine/posterior/posterior.h"
#include "engine/run/mode_search.h"
#include "engine/run/run_settings.h"
#include "engine/run/run_shared.h"

namespace patina {

/// Finds the match that a run's chains are about, and has the posterior that they are of, with errors that
/// are set by hand, measured at the match, or learnt (RunSettings::errors). Keeps the run's status up to
/// date.
class MatchFinder {
 public:
  /// Called with the best match so far, by any thread, one at a time.
  using Keep = std::function<void(const MapPoint& best)>;

  /// All but `keep` outlive it. @throws UserError for unknown names, priors and networks, and for a posterior
  /// without free parameters
  MatchFinder(const RunSettings& settings, const Image& photo, RunShared& shared, Keep keep);

  /// Of the fewest pixels that a search looks at, until a match is found.
  const Posterior& posterior() const { return *posteriors_.back(); }
  bool emulates() const { return emulates_; }  ///< whether renders are to be emulated

  /// By a search; with learnt errors from the photos of the prior that these begin with. @throws RunStopped
  ModeFound find();

  /// The posterior that a match was found under before.
  void take_up(const ModeFound& found);

  /// Whether errors are measured at the match, and renders averaged over irregularities. Not of itself for a
  /// match alone, with no draws to follow: errors that forgive what irregularities do forgive colours, too
  /// (wood_3's are off by 6.1 in place of 2.5, resources/fits).
  bool averages() const;

  /// What a search ended in by hand-set errors, at least one place, best first, found again by measured ones.
  /// @throws RunStopped
  ModeFound average_over(const std::vector<MapPoint>& basins);

  /// That simulated photos, and the renders that an average is learnt from, have.
  IrregularityPool& irregularities();

  std::unique_ptr<Posterior> coarsest() const;  ///< the first level of the search's pyramid

  /// How the photo compares with those that errors were learnt from, if they were.
  const std::optional<PhotoFit>& photo_fit() const { return photo_fit_; }

 private:
  bool is_calibrated() const { return settings_.errors == "calibrated"; }
  std::vector<Position> guesses() const;  ///< where the search looks first
  MapSearchResult search(const std::vector<std::unique_ptr<Posterior>>& pyramid) const;
  void keep_the_finest();
  ModeFound calibrate();
  Position coarse_match();  ///< the best match by hand-set errors, at the fewest pixels that show it
  void show(const Position& position) const;
  void use(const CalibratedErrors& errors);
  void use(const WiderErrors& wider);

  const RunSettings& settings_;
  const Image& photo_;
  RunShared& shared_;
  Keep keep_;
  std::vector<std::unique_ptr<Posterior>> posteriors_;  ///< coarse to fine; only the finest is sampled
  bool emulates_;
  std::shared_ptr<IrregularityPool> pool_;  ///< see irregularities()
  std::optional<PhotoFit> photo_fit_;
};

}  // namespace patina
