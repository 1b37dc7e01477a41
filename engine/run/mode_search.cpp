#include "engine/run/mode_search.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/error.h"
#include "engine/format.h"
#include "engine/run/controlled_density.h"
#include "engine/run/threads.h"

namespace patina {
namespace {

/// At fewer pixels the grain that tells leathers apart is gone, and the search settles in the wrong basin.
constexpr int kCoarsest = 128;

/// From guesses that are about right.
MapSearchSettings local_search() {
  MapSearchSettings settings;
  settings.prior_draws = 8;
  settings.descents = 2;
  settings.finalists = 1;
  return settings;
}

void report(RunShared& shared, const Posterior& posterior, double fraction, const Position& best, double lp) {
  shared.edit_status([&](RunStatus& status) {
    status.search_fraction = fraction;
    status.message = "looking for a good match: " + std::to_string(std::lround(100 * fraction)) + " %";
    status.best = posterior.values(best);
    status.best_lp = lp;
  });
}

/// "found a match, the next best 12.3 nats behind".
std::string basins_in_words(const std::vector<OptimizerResult>& basins) {
  if (basins.size() < 2) return "found a match";
  return format("found a match, the next best %.1f nats behind",
                basins[0].evaluation.log_density - basins[1].evaluation.log_density);
}

}  // namespace

MapSearchSettings search_before_average() {
  MapSearchSettings settings;
  settings.finalists = 3;
  return settings;
}

std::vector<int> pyramid(int resolution) {
  std::vector<int> levels;
  for (int level = kCoarsest; level < resolution; level *= 2) levels.push_back(level);
  levels.push_back(resolution);
  return levels;
}

MapSearchResult find_matches(const std::vector<std::unique_ptr<Posterior>>& posteriors,
                             const RunSettings& settings, const std::vector<Position>& guesses,
                             bool average_follows, RunShared& shared,
                             const std::function<void(const MapPoint&)>& keep) {
  std::vector<std::unique_ptr<ControlledDensity>> controlled;
  std::vector<const LogDensity*> targets;
  for (const auto& posterior : posteriors) {
    controlled.push_back(std::make_unique<ControlledDensity>(*posterior, shared.control));
    targets.push_back(controlled.back().get());
  }
  const Posterior& posterior = *posteriors.back();
  MapSearchSettings search = settings.start == "predict" ? local_search()
                             : average_follows           ? search_before_average()
                                                         : MapSearchSettings{};
  search.guesses = guesses;
  search.threads = hardware_threads();
  search.enter_thread = [] { use_tensor_threads(1); };
  search.progress = [&](double fraction, const Position& best, double lp) {
    report(shared, posterior, fraction, best, lp);
    keep({posterior.values(best), lp});
  };
  Rng rng(settings.seed, 0);
  MapSearchResult result = search_map(targets, rng, search);
  const OptimizerResult& best = result.best;
  if (!std::isfinite(best.evaluation.log_density))
    throw UserError("No parameters render to anything comparable with the photo: check the priors.");
  report(shared, posterior, 1, best.position, best.evaluation.log_density);
  return result;
}

std::vector<MapPoint> basins_of(const Posterior& posterior, const std::vector<OptimizerResult>& found) {
  std::vector<MapPoint> basins;
  for (const OptimizerResult& end : found)
    basins.push_back({posterior.values(end.position), end.evaluation.log_density});
  return basins;
}

ModeFound mode_of(const Posterior& posterior, const std::vector<OptimizerResult>& found, RunShared& shared) {
  shared.edit_status([&](RunStatus& status) {
    status.message = basins_in_words(found) + ", measuring how far good matches spread";
  });
  const OptimizerResult& best = found.front();
  const ControlledDensity target(posterior, shared.control);
  return {{best.position, best.evaluation},
          std::make_shared<const Metric>(
              laplace_covariance(target, best.position, hardware_threads(), [] { use_tensor_threads(1); })),
          basins_of(posterior, found)};
}

}  // namespace patina
