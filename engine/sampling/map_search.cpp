#include "engine/sampling/map_search.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <utility>
#include <vector>

#include "engine/sampling/best_first.h"
#include "engine/sampling/evolution.h"
#include "engine/sampling/finite_evaluation.h"
#include "engine/sampling/parallel_for.h"
#include "engine/sampling/prior_draw.h"

namespace patina {
namespace {

constexpr double kSameBasin = 0.3;  // prior standard deviations

// Evolution of targets with jagged coordinates: about the prior, about a guess, and about a finalist, in sds
// of Laplace's approximation.
constexpr double kPriorSpread = 0.8, kGuessSpread = 0.4, kFinalistSpread = 0.5;
constexpr int kLeastGenerations = 80;
constexpr int kFinalistShare = 2;  // so many times fewer generations, of half as many: their shape is known
constexpr int kFinalistPopulation = 12;
// What climbs of gradients do better: a finalist gains less than half a nat from there on.
constexpr double kFinalistNarrow = 0.05;
// Who has found nothing better than its start after a quarter of the generations does not; whoever of 28
// did, had after five.
constexpr int kGainBy = 4;
// Nats behind the best on the coarsest target: who is further behind is not refined. It may look as good by
// what finer targets add (rings narrower than a pixel, of wood_3), but not by what both see.
constexpr double kOutrun = 15;
// Behind the best before, in nats: who is further behind after half of the generations stays so.
constexpr double kHopeless = 100;
constexpr double kValueCost = 0.5;  // of an evaluation's with gradient

constexpr int kGuessesClimbed = 3;

constexpr double kCostRatio = 4;  // of an evaluation on the next finer target: twice the pixels a side

bool same_basin(const Position& a, const Position& b) {
  return a.discrete == b.discrete && (a.continuous - b.continuous).norm() <= kSameBasin;
}

/// The best `count` that are not in the basin of a better one; `results` sorted.
std::vector<OptimizerResult> distinct(const std::vector<OptimizerResult>& results, int count) {
  std::vector<OptimizerResult> kept;
  for (const OptimizerResult& result : results) {
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const OptimizerResult& other) {
      return same_basin(other.position, result.position);
    });
    if (!known && kept.size() < static_cast<std::size_t>(count)) kept.push_back(result);
  }
  return kept;
}

/// One search; each stage takes the last one's results and does nothing once a stop is requested.
class Search {
 public:
  Search(const std::vector<const LogDensity*>& targets, Rng& rng, const MapSearchSettings& settings)
      : targets_(targets),
        rng_(rng),
        settings_(settings),
        levels_(targets.front()->discrete_levels()),
        jagged_(targets.front()->jagged()) {
    total_ = candidate_count() + climb_count() * settings.coarse_iterations;
    total_ += settings.finalists * levels_.size() * short_climb();
    if (has_jagged())
      total_ += kValueCost * generations() *
                (EvolutionSettings{}.population * settings.evolutions +
                 kFinalistPopulation * finalist_count() * cost(grain_target()) / kFinalistShare);
    for (std::size_t i = 1; i < targets.size(); ++i)
      total_ += settings.finalists * settings.fine_iterations * cost(i);
  }

  MapSearchResult run() {
    // Guesses are looked at first, so that who watches sees them early. What they lead to has a place among
    // the finalists: at few pixels another basin may look as good.
    std::vector<OptimizerResult> guesses = best_of(settings_.guesses, kGuessesClimbed);
    std::vector<OptimizerResult> candidates = best_of(prior_candidates(), std::max(settings_.descents, 1));
    if (has_jagged()) evolve_all(guesses, candidates);
    std::vector<OptimizerResult> results = coarse_stage(std::move(candidates), finalist_count());
    for (OptimizerResult& found : coarse_stage(std::move(guesses), 1)) results.push_back(std::move(found));
    const int places = finalist_count() + (settings_.guesses.empty() ? 0 : 1);
    sort_best_first(results);
    results = distinct(results, places);
    if (has_jagged()) refine_all(results);
    for (std::size_t i = 1; i < targets_.size(); ++i) climb_all(results, i, settings_.fine_iterations);
    if (stopped()) return best_so_far();
    report(results.front(), total_ - done_);
    return {results.front(), distinct(results, places)};  // climbs may have met
  }

 private:
  bool stopped() const { return settings_.stop_requested && settings_.stop_requested(); }
  int finalist_count() const { return std::max(settings_.finalists, 1); }
  static double cost(std::size_t target) { return std::pow(kCostRatio, target); }
  int generations() const {
    return std::max(kLeastGenerations,
                    settings_.generations * static_cast<int>(targets_.front()->dimension()));
  }
  int short_climb() const { return std::max(settings_.coarse_iterations / 4, 1); }

  void for_all(std::size_t count, const std::function<void(std::size_t)>& work) const {
    parallel_for(count, settings_.threads, work, settings_.enter_thread);
  }

  static Evaluation nothing(Eigen::Index dimension) {
    return {-std::numeric_limits<double>::infinity(), Eigen::VectorXd::Zero(dimension)};
  }

  OptimizerResult evaluate(const LogDensity& target, Position position) const {
    OptimizerResult result;
    result.evaluation = evaluate_finite(target, position);
    result.position = std::move(position);
    result.evaluations = 1;
    return result;
  }

  double climb_count() const {
    if (has_jagged()) return settings_.evolutions;
    return settings_.descents +
           std::min<double>(kGuessesClimbed, static_cast<double>(settings_.guesses.size()));
  }
  double candidate_count() const {
    return 1.0 + prior_draws() + static_cast<double>(settings_.guesses.size());
  }
  int prior_draws() const { return has_jagged() ? 0 : settings_.prior_draws; }  // evolution makes its own

  /// Climbs and sweeps on the coarsest target. @return the best `count` basins that were found
  std::vector<OptimizerResult> coarse_stage(std::vector<OptimizerResult> results, int count) {
    if (results.empty()) return results;
    climb_all(results, 0, settings_.coarse_iterations);
    // A sweep may lead several finalists to one basin; what was climbed before then fills their places.
    std::vector<OptimizerResult> finalists = distinct(results, count);
    for_all(finalists.size(), [&](std::size_t i) { sweep_levels(finalists[i]); });
    results.insert(results.end(), finalists.begin(), finalists.end());
    sort_best_first(results);
    return distinct(results, count);
  }

  /// The prior's mode, then draws from the prior.
  std::vector<Position> prior_candidates() {
    const Eigen::Index n = targets_.front()->dimension();
    std::vector<Position> positions;
    for (int i = 0; i <= prior_draws(); ++i)
      positions.push_back({i == 0 ? Eigen::VectorXd::Zero(n) : rng_.normals(n), draw_levels(levels_, rng_)});
    return positions;
  }

  /// So many of the places, best first, on the coarsest target; at least one of at least one.
  std::vector<OptimizerResult> best_of(const std::vector<Position>& places, int count) {
    std::vector<OptimizerResult> results(places.size());
    for_all(results.size(), [&](std::size_t i) {
      results[i].position = places[i];
      results[i].evaluation = nothing(places[i].continuous.size());
      if (i > 0 && stopped()) return;
      results[i] = evaluate(*targets_.front(), places[i]);
      report(results[i], 1);
    });
    sort_best_first(results);
    results.resize(std::min(results.size(), static_cast<std::size_t>(count)));
    return results;
  }

  void begin_on(std::size_t target) {
    best_known_ = best_known_ && target == best_target_;  // log densities of two targets do not compare
    best_target_ = target;
  }

  void climb_all(std::vector<OptimizerResult>& results, std::size_t target, int iterations) {
    begin_on(target);
    for_all(results.size(), [&](std::size_t i) {
      if (stopped()) return;
      results[i] = climb(*targets_[target], results[i].position, iterations);
      report(results[i], iterations * cost(target));
    });
    sort_best_first(results);
  }

  OptimizerResult climb(const LogDensity& target, const Position& start, int iterations) const {
    OptimizerSettings settings;
    settings.max_iterations = iterations;
    settings.stop_requested = settings_.stop_requested;
    return maximize(target, start, settings);
  }

  /// For each discrete coordinate the best of the other levels is climbed from for a while, since the
  /// continuous coordinates fit the current level only, and kept if it ends above.
  void sweep_levels(OptimizerResult& result) {
    const LogDensity& target = *targets_.front();
    for (std::size_t i = 0; i < levels_.size() && !stopped(); ++i) {
      std::vector<OptimizerResult> others;
      for (int level = 0; level < levels_[i] && !stopped(); ++level) {
        if (level == result.position.discrete[i]) continue;
        Position position = result.position;
        position.discrete[i] = level;
        others.push_back(evaluate(target, std::move(position)));
      }
      if (others.empty() || stopped()) continue;
      sort_best_first(others);
      OptimizerResult rival = climb(target, others.front().position, short_climb());
      if (rival.evaluation.log_density > result.evaluation.log_density) result = std::move(rival);
      report(result, short_climb());
    }
  }

  bool has_jagged() const { return std::ranges::count(jagged_, true) > 0; }

  /// The first target on which a grain that the coarsest one blurs tells how large it is; finer ones would
  /// say the same at several times the cost.
  std::size_t grain_target() const { return std::min<std::size_t>(targets_.size() - 1, 1); }

  /// One generation after the other, each on all threads. Ends early where it gains nothing.
  /// @param least  ends half-way where its best is below
  OptimizerResult evolve(std::size_t target, const Position& start, EvolutionSettings evolution,
                         double least = -std::numeric_limits<double>::infinity()) {
    const double work = kValueCost * evolution.population * cost(target);
    const int all = evolution.generations;
    int made = 0;
    bool hopeless = false;
    evolution.threads = settings_.threads;
    evolution.enter_thread = settings_.enter_thread;
    evolution.stop_requested = [&] { return hopeless || stopped(); };
    evolution.evolved = [&](const OptimizerResult& best) {
      ++made;
      const bool gains = best.position.continuous != start.continuous;
      hopeless =
          (made == all / kGainBy && !gains) || (made == all / 2 && best.evaluation.log_density < least);
      report(best, work);
    };
    OptimizerResult result = patina::evolve(*targets_[target], start, rng_, evolution);
    report(result, (all - made) * work);
    return result;
  }

  /// Evolves the best guess, and from the whole prior at random levels; what comes of it takes the place of
  /// what would have been climbed.
  void evolve_all(std::vector<OptimizerResult>& guesses, std::vector<OptimizerResult>& candidates) {
    if (!guesses.empty())
      guesses.assign(
          1, evolve(0, guesses.front().position, {.spread = kGuessSpread, .generations = generations()}));
    const int count = std::max(settings_.evolutions - static_cast<int>(guesses.size()), 1);
    const Eigen::VectorXd middle = Eigen::VectorXd::Zero(targets_.front()->dimension());
    std::vector<OptimizerResult> evolved;
    double top =
        guesses.empty() ? -std::numeric_limits<double>::infinity() : guesses.front().evaluation.log_density;
    for (int i = 0; i < count && !stopped(); ++i) {
      const Position start{middle, draw_levels(levels_, rng_)};
      evolved.push_back(
          evolve(0, start, {.spread = kPriorSpread, .generations = generations()}, top - kHopeless));
      top = std::max(top, evolved.back().evaluation.log_density);
    }
    if (!stopped()) candidates = std::move(evolved);
  }

  /// Evolves each that is not outrun once more where the grain tells; coarser targets cannot, but know how
  /// far to look.
  void refine_all(std::vector<OptimizerResult>& results) {
    double top = results.front().evaluation.log_density;
    std::erase_if(results, [&](const auto& result) { return result.evaluation.log_density < top - kOutrun; });
    std::vector<Eigen::MatrixXd> shapes(results.size());
    for_all(results.size(), [&](std::size_t i) {
      if (!stopped() && std::isfinite(results[i].evaluation.log_density))
        shapes[i] = laplace_covariance(*targets_.front(), results[i].position);
    });
    begin_on(grain_target());
    top = -std::numeric_limits<double>::infinity();  // of another target
    for (std::size_t i = 0; i < results.size() && !stopped(); ++i) {
      results[i] = evolve(grain_target(), results[i].position,
                          {.spread = kFinalistSpread,
                           .shape = shapes[i],
                           .population = kFinalistPopulation,
                           .generations = generations() / kFinalistShare,
                           .narrow = kFinalistNarrow},
                          top - kHopeless);
      top = std::max(top, results[i].evaluation.log_density);
    }
    sort_best_first(results);
    if (targets_.size() == 1) climb_all(results, 0, settings_.fine_iterations);
  }

  void report(const OptimizerResult& result, double work) {
    const std::lock_guard lock(mutex_);
    done_ += work;
    if (!best_known_ || result.evaluation.log_density > best_.evaluation.log_density) best_ = result;
    best_known_ = true;
    if (settings_.progress)
      settings_.progress(std::min(done_ / total_, 1.0), best_.position, best_.evaluation.log_density);
  }

  /// After a stop: one evaluation, so that the result's log density is the finest target's all the same.
  MapSearchResult best_so_far() const {
    const OptimizerResult best = evaluate(*targets_.back(), best_.position);
    return {best, {best}};
  }

  const std::vector<const LogDensity*>& targets_;
  Rng& rng_;
  const MapSearchSettings& settings_;
  std::vector<int> levels_;
  std::vector<bool> jagged_;
  std::mutex mutex_;  ///< guards what report() keeps
  OptimizerResult best_;
  bool best_known_ = false;
  std::size_t best_target_ = 0;
  double done_ = 0, total_ = 0;
};

}  // namespace

MapSearchResult search_map(const std::vector<const LogDensity*>& targets, Rng& rng,
                           const MapSearchSettings& settings) {
  assert(!targets.empty());
  return Search(targets, rng, settings).run();
}

}  // namespace patina
