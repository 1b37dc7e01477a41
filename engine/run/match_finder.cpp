#include "engine/run/match_finder.h"

#include <utility>

#include "engine/error.h"
#include "engine/posterior/wider_errors.h"
#include "engine/run/calibrated_errors.h"
#include "engine/run/emulated_proposals.h"
#include "engine/run/posterior_settings.h"
#include "engine/run/predicted_start.h"
#include "engine/run/widened_errors.h"
#include "engine/sampling/kernels.h"

namespace patina {

MatchFinder::MatchFinder(const RunSettings& settings, const Image& photo, RunShared& shared, Keep keep)
    : settings_(settings), photo_(photo), shared_(shared), keep_(std::move(keep)) {
  posteriors_.push_back(coarsest());  // which costs little and refuses what any other would
  if (posterior().dimension() == 0)
    throw UserError("Every continuous parameter is held fixed: leave at least one free to be inferred.");
  emulates_ = patina::emulates(settings_, posterior());
}

std::unique_ptr<Posterior> MatchFinder::coarsest() const {
  return std::make_unique<Posterior>(search_settings(settings_, pyramid(settings_.resolution).front()),
                                     photo_);
}

bool MatchFinder::averages() const {
  return settings_.errors == "averaged" ||
         (settings_.errors == kAuto && !settings_.map_only && emulates_ && has_jagged(posterior()));
}

IrregularityPool& MatchFinder::irregularities() {
  if (!pool_) pool_ = make_pool(posterior().table(), kSimulatedSeeds, kIrregularityPhotos);
  return *pool_;
}

std::vector<Position> MatchFinder::guesses() const {
  const bool knows_better = settings_.start != "map" && settings_.start != "predict";
  if (knows_better) return {};
  return predicted_guesses(*posteriors_.front(), photo_, settings_.capture, settings_.seed);
}

MapSearchResult MatchFinder::search(const std::vector<std::unique_ptr<Posterior>>& pyramid) const {
  return find_matches(pyramid, settings_, guesses(), averages(), shared_, keep_);
}

ModeFound MatchFinder::find() {
  if (is_calibrated()) return calibrate();
  const std::vector<int> levels = pyramid(settings_.resolution);
  for (std::size_t i = posteriors_.size(); i < levels.size(); ++i) {
    shared_.control.checkpoint();
    posteriors_.push_back(std::make_unique<Posterior>(search_settings(settings_, levels[i]), photo_));
  }
  const std::vector<OptimizerResult> found = search(posteriors_).basins;
  posteriors_.erase(posteriors_.begin(), posteriors_.end() - 1);
  if (!averages()) return mode_of(posterior(), found, shared_);
  return average_over(basins_of(posterior(), found));
}

void MatchFinder::take_up(const ModeFound& found) {
  keep_the_finest();
  if (found.errors) use(*found.errors);
  if (found.wider) use(*found.wider);
}

ModeFound MatchFinder::average_over(const std::vector<MapPoint>& basins) {
  std::vector<Position> ends;
  for (const MapPoint& basin : basins) ends.push_back(posterior().position(basin.values));
  ModeFound again = widened(posterior(), ends, irregularities(), settings_.seed, shared_);
  use(*again.wider);
  show(again.mode.position);
  return again;
}

void MatchFinder::keep_the_finest() {
  if (settings_.resolution != pyramid(settings_.resolution).front())
    posteriors_.push_back(
        std::make_unique<Posterior>(posterior_settings(settings_, settings_.resolution), photo_));
  posteriors_.erase(posteriors_.begin(), posteriors_.end() - 1);
}

ModeFound MatchFinder::calibrate() {
  keep_the_finest();
  // There is something to see while photos are simulated.
  if (const auto guessed = guesses(); !guessed.empty()) show(guessed.front());
  CalibratedMode calibrated =
      calibrate_errors(posterior(), photo_, settings_, shared_, [this] { return coarse_match(); });
  use(calibrated.errors);
  show(calibrated.mode.position);
  return {.mode = std::move(calibrated.mode),
          .laplace = std::move(calibrated.laplace),
          .errors = std::move(calibrated.errors)};
}

Position MatchFinder::coarse_match() {
  std::vector<std::unique_ptr<Posterior>> coarse;
  coarse.push_back(coarsest());
  Position match = search(coarse).best.position;
  shared_.edit_status([](RunStatus& status) { status.search_fraction = 0; });  // photos are simulated again
  return match;
}

void MatchFinder::show(const Position& position) const {
  const MapPoint point{posterior().values(position), posterior().value(position).log_density};
  shared_.edit_status([&](RunStatus& status) {
    status.best = point.values;
    status.best_lp = point.lp;
  });
  keep_(point);
}

void MatchFinder::use(const CalibratedErrors& errors) {
  posteriors_.back() = std::make_unique<Posterior>(posterior().with(errors.likelihood));
  photo_fit_ = errors.fit;
}

void MatchFinder::use(const WiderErrors& wider) {
  posteriors_.back() = std::make_unique<Posterior>(posterior().with(wider));
}

}  // namespace patina
