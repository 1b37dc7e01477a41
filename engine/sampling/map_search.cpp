#include "engine/sampling/map_search.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <utility>
#include <vector>

#include "engine/sampling/finite_evaluation.h"
#include "engine/sampling/parallel_for.h"
#include "engine/sampling/prior_draw.h"

namespace patina {
namespace {

constexpr double kSameBasin = 0.3;  // prior standard deviations

// The walk along jagged coordinates, in prior standard deviations and nats.
// On the finest target, where it is decided, it is three times as long.
constexpr int kWalkRounds = 5, kFineWalkRounds = 15, kStepsPerRound = 6;
constexpr double kWidestWalk = 0.5, kNarrowestWalk = 0.065, kNearlyAsGood = 5;

constexpr int kGuessesClimbed = 3;

constexpr double kCostRatio = 4;  // of an evaluation on the next finer target: twice the pixels a side

bool same_basin(const Position& a, const Position& b) {
  return a.discrete == b.discrete && (a.continuous - b.continuous).norm() <= kSameBasin;
}

void sort_best_first(std::vector<OptimizerResult>& results) {
  std::stable_sort(results.begin(), results.end(), [](const OptimizerResult& a, const OptimizerResult& b) {
    return a.evaluation.log_density > b.evaluation.log_density;
  });
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
      total_ +=
          settings.finalists * short_climb() * (kWalkRounds + kFineWalkRounds * cost(targets.size() - 1));
    for (std::size_t i = 1; i < targets.size(); ++i)
      total_ += settings.finalists * settings.fine_iterations * cost(i);
  }

  MapSearchResult run() {
    // Guesses are looked at first, so that who watches sees them early. What they lead to has a place among
    // the finalists: at few pixels another basin may look as good.
    std::vector<OptimizerResult> guesses = best_of(settings_.guesses, kGuessesClimbed);
    std::vector<OptimizerResult> results =
        coarse_stage(best_of(prior_candidates(), std::max(settings_.descents, 1)), finalist_count());
    for (OptimizerResult& found : coarse_stage(std::move(guesses), 1)) results.push_back(std::move(found));
    const int places = finalist_count() + (settings_.guesses.empty() ? 0 : 1);
    sort_best_first(results);
    results = distinct(results, places);
    for (std::size_t i = 1; i < targets_.size(); ++i) climb_all(results, i, settings_.fine_iterations);
    // A grain that the coarsest target blurs tells only here how large it is.
    if (has_jagged() && targets_.size() > 1) walk_all(results, targets_.size() - 1);
    if (stopped()) return best_so_far();
    report(results.front(), total_ - done_);
    return {results.front(), distinct(results, places)};  // climbs may have met
  }

 private:
  bool stopped() const { return settings_.stop_requested && settings_.stop_requested(); }
  int finalist_count() const { return std::max(settings_.finalists, 1); }
  static double cost(std::size_t target) { return std::pow(kCostRatio, target); }
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
    return settings_.descents +
           std::min<double>(kGuessesClimbed, static_cast<double>(settings_.guesses.size()));
  }
  double candidate_count() const {
    return 1.0 + settings_.prior_draws + static_cast<double>(settings_.guesses.size());
  }

  /// Climbs, sweeps and walks on the coarsest target. @return the best `count` basins that were found
  std::vector<OptimizerResult> coarse_stage(std::vector<OptimizerResult> results, int count) {
    if (results.empty()) return results;
    climb_all(results, 0, settings_.coarse_iterations);
    // A sweep may lead several finalists to one basin; what was climbed before then fills their places.
    std::vector<OptimizerResult> finalists = distinct(results, count);
    for_all(finalists.size(), [&](std::size_t i) { sweep_levels(finalists[i]); });
    if (has_jagged()) walk_all(finalists, 0);
    results.insert(results.end(), finalists.begin(), finalists.end());
    sort_best_first(results);
    return distinct(results, count);
  }

  /// The prior's mode, then draws from the prior.
  std::vector<Position> prior_candidates() {
    const Eigen::Index n = targets_.front()->dimension();
    std::vector<Position> positions;
    for (int i = 0; i <= settings_.prior_draws; ++i)
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

  void climb_all(std::vector<OptimizerResult>& results, std::size_t target, int iterations) {
    best_known_ = best_known_ && target == best_target_;  // log densities of two targets do not compare
    best_target_ = target;
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

  void walk_all(std::vector<OptimizerResult>& results, std::size_t target) {
    std::vector<Eigen::MatrixXd>
        steps;  // drawn before the threads start, in an order that is always the same
    for (std::size_t i = 0; i < results.size(); ++i)
      steps.push_back(jagged_steps(target == 0 ? kWalkRounds : kFineWalkRounds));
    for_all(results.size(), [&](std::size_t i) { walk(target, results[i], steps[i]); });
    sort_best_first(results);
  }

  /// A step a column, narrower from round to round. Every other one moves all jagged coordinates, those
  /// between them one each in turn: a size may be wrong where the place is right.
  Eigen::MatrixXd jagged_steps(int rounds) {
    const Eigen::Index n = targets_.front()->dimension();
    std::vector<Eigen::Index> jagged;
    for (Eigen::Index k = 0; k < n; ++k)
      if (jagged_[static_cast<std::size_t>(k)]) jagged.push_back(k);
    Eigen::MatrixXd steps = Eigen::MatrixXd::Zero(n, rounds * kStepsPerRound);
    for (int i = 0; i < steps.cols(); ++i) {
      const double share = static_cast<double>(i / kStepsPerRound) / (rounds - 1);
      const double spread = kWidestWalk * std::pow(kNarrowestWalk / kWidestWalk, share);
      if (i % 2 == 0)
        steps(jagged[static_cast<std::size_t>(i / 2) % jagged.size()], i) = spread * rng_.normal();
      else
        for (const Eigen::Index k : jagged) steps(k, i) = spread * rng_.normal();
    }
    return steps;
  }

  void walk(std::size_t level, OptimizerResult& result, const Eigen::MatrixXd& steps) {
    const LogDensity& target = *targets_[level];
    for (int round = 0; (round + 1) * kStepsPerRound <= steps.cols() && !stopped(); ++round) {
      std::vector<OptimizerResult> places;
      for (int i = 0; i < kStepsPerRound && !stopped(); ++i) {
        Position position = result.position;
        position.continuous += steps.col(round * kStepsPerRound + i);
        places.push_back(evaluate(target, std::move(position)));
      }
      if (places.empty() || stopped()) return;
      sort_best_first(places);
      // The other coordinates fit the place they were climbed at: what is nearly as good may end above.
      if (places.front().evaluation.log_density > result.evaluation.log_density - kNearlyAsGood) {
        OptimizerResult rival = climb(target, places.front().position, short_climb());
        if (rival.evaluation.log_density > result.evaluation.log_density) result = std::move(rival);
      }
      report(result, short_climb() * cost(level));
    }
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
