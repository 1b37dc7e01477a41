#include "engine/comparison/rank_materials.h"

#include <algorithm>
#include <memory>
#include <mutex>

#include "engine/comparison/material_evidence.h"
#include "engine/comparison/material_glance.h"
#include "engine/comparison/ranking_words.h"
#include "engine/error.h"
#include "engine/material/registry.h"
#include "engine/run/run_checks.h"
#include "engine/run/run_control.h"
#include "engine/run/run_settings.h"
#include "engine/run/threads.h"

namespace patina {
namespace {

// What is so far behind in the first cut is not measured again, nats.
constexpr double kHopeless = 12;

void check(const RankSettings& settings) {
  if (settings.resolution < kLeastRankResolution)
    throw UserError("Materials are compared at " + std::to_string(kLeastRankResolution) +
                    " pixels a side or more: choose a larger resolution.");
  check_resolution(settings.resolution);
  check_capture(settings.capture);
  for (const std::string& name : settings.materials) material_table(name);  // throws for one that is none
  for (auto name = settings.materials.begin(); name != settings.materials.end(); ++name)
    if (std::find(settings.materials.begin(), name, *name) != name)
      throw UserError("The material '" + *name + "' is named twice: name each once.");
}

RankSettings completed(RankSettings settings) {
  if (settings.materials.empty()) settings.materials = material_names();
  if (settings.threads <= 0) settings.threads = hardware_threads();
  return settings;
}

/// Passes on the share of all work that is done, from several threads one at a time.
class Report {
 public:
  using Progress = std::function<void(double, const std::string&)>;
  explicit Report(const Progress& progress) : progress_(progress) {}

  void operator()(double fraction, const std::string& doing) {
    const std::lock_guard lock(mutex_);
    furthest_ = std::max(furthest_, std::min(fraction, 1.0));
    if (progress_) progress_(furthest_, doing);
  }

 private:
  const Progress& progress_;
  std::mutex mutex_;
  double furthest_ = 0;
};

class Ranking {
 public:
  Ranking(const Image& photo, const RankSettings& settings, RunControl& control, Report& report)
      : settings_(settings), control_(control), report_(report) {
    const std::vector<double> seen = glances(photo, settings.materials);
    for (std::size_t i = 0; i < settings.materials.size(); ++i)
      candidates_.push_back(std::make_unique<MaterialEvidence>(settings.materials[i], settings, photo,
                                                               seen.empty() ? 0 : seen[i]));
  }

  MaterialRanking run() {
    const double foretold = settings_.finalists > 0 ? 0.4 : 1, searched = 0.9 * foretold;
    work_through(0, searched, "looking for a match in ", &MaterialEvidence::search);
    work_through(searched, foretold, "foretelling quarters by ", &MaterialEvidence::foretell);
    drop_the_hopeless();
    if (settings_.finalists > 0) work_through(foretold, 1, "weighing ", &MaterialEvidence::measure);
    MaterialRanking ranking;
    for (const auto* group : {&candidates_, &dropped_})
      for (const auto& candidate : *group) ranking.materials.push_back(candidate->ranked());
    put_in_order(ranking.materials);
    compare_samples(ranking.materials.front());
    ranking.summary = settings_.summary;
    ranking.sentence = in_words(ranking);
    return ranking;
  }

 private:
  using Stage = void (MaterialEvidence::*)(int, RunControl&, const std::function<void(double)>&);

  void work_through(double from, double to, const std::string& doing, Stage stage) {
    const auto count = static_cast<double>(candidates_.size());
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      const std::string what = doing + candidates_[i]->ranked().material;
      (*candidates_[i].*stage)(settings_.threads, control_, [&](double fraction) {
        report_(from + (to - from) * (static_cast<double>(i) + fraction) / count, what);
      });
    }
  }

  void compare_samples(RankedMaterial& first) {
    for (const auto* group : {&candidates_, &dropped_})
      for (const auto& candidate : *group) {
        if (candidate->ranked().material != first.material) continue;
        candidate->compare_samples();
        first.misfit_of_another_sample = candidate->ranked().misfit_of_another_sample;
      }
  }

  /// Keeps the finalists: none where the first is far ahead of all others.
  void drop_the_hopeless() {
    const auto odds = [&](const auto& candidate) { return log_odds(candidate->ranked()); };
    std::ranges::stable_sort(candidates_, std::greater(), odds);
    const double best = odds(candidates_.front());
    const auto in_the_running =
        std::ranges::count_if(candidates_, [&](const auto& c) { return odds(c) > best - kHopeless; });
    const auto kept = in_the_running < 2 ? 0 : std::min<std::ptrdiff_t>(in_the_running, settings_.finalists);
    for (auto c = candidates_.begin() + kept; c != candidates_.end(); ++c) dropped_.push_back(std::move(*c));
    candidates_.resize(static_cast<std::size_t>(kept));
  }

  const RankSettings& settings_;
  RunControl& control_;
  Report& report_;
  std::vector<std::unique_ptr<MaterialEvidence>> candidates_, dropped_;
};

}  // namespace

RankSettings first_cut(const RunSettings& settings, const Capture& capture) {
  RankSettings rank;
  rank.capture = capture;
  rank.network = settings.network;
  rank.glance = can_glance(material_names());
  rank.finalists = 0;
  rank.seed = settings.seed;
  rank.z_seed = settings.z_seed;
  return rank;
}

std::optional<MaterialRanking> rank_materials(
    const Image& photo, const RankSettings& settings,
    const std::function<void(double fraction, const std::string& doing)>& progress, std::stop_token stop) {
  check(settings);
  const RankSettings complete = completed(settings);
  if (complete.glance) return glance(photo, complete);
  RunControl control;
  const std::stop_callback pass_on(std::move(stop), [&] { control.stop(); });
  Report report(progress);
  try {
    return Ranking(photo, complete, control, report).run();
  } catch (const RunStopped&) {
    return std::nullopt;
  }
}

}  // namespace patina
