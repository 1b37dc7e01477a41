#include "engine/run/emulated_proposals.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <utility>

#include "engine/error.h"
#include "engine/format.h"
#include "engine/io/chain_csv.h"
#include "engine/run/chain_start.h"
#include "engine/run/controlled_density.h"
#include "engine/run/draw.h"
#include "engine/run/run_files.h"
#include "engine/run/threads.h"
#include "engine/sampling/best_first.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/parallel_for.h"
#include "engine/sampling/valley.h"

namespace patina {
namespace {

constexpr std::size_t kStartsAWalker = 2;
// Apart from the search's and the chains'.
constexpr std::uint64_t kSpreadStream = 0x7370'7265'6164, kNearerStream = 0x6e65'6172'6572;

/// Why a run's proposals cannot be emulated; empty if they may be.
std::string hindrance(const RunSettings& settings, const Posterior& posterior) {
  if (!can_emulate(posterior)) return "has nothing to follow where places of a texture alone are free";
  if (settings.errors == "calibrated") return "is of no use with calibrated errors, which need no renders";
  if (settings.temper != 0) return "has no ladder";
  if (settings.start != "map") return "begins at the best match alone";
  return "";
}

/// The first `kept` places, then others up to `count`, each as far from those before it as may be.
/// @param sds  units of distance, of each coordinate
std::vector<ChainState> furthest_apart(const std::vector<ChainState>& places, std::size_t kept,
                                       std::size_t count, const Eigen::VectorXd& sds) {
  std::vector<ChainState> chosen(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(kept));
  std::vector<double> distances(places.size(), std::numeric_limits<double>::infinity());
  const auto note = [&](const ChainState& taken) {
    for (std::size_t i = 0; i < places.size(); ++i)
      distances[i] = std::min(
          distances[i],
          (places[i].position.continuous - taken.position.continuous).cwiseQuotient(sds).squaredNorm());
  };
  for (const ChainState& state : chosen) note(state);
  while (chosen.size() < count) {
    const auto furthest = std::ranges::max_element(distances) - distances.begin();
    chosen.push_back(places[static_cast<std::size_t>(furthest)]);
    note(chosen.back());
  }
  return chosen;
}

/// On all processors, the run's status kept up to date. @param evaluated  counts; outlives the result
EmulateSettings learning(const RunSettings& run, RunShared& shared, std::atomic<int>& evaluated) {
  constexpr int kEvaluationsAMessage = 20;
  return {.threads = hardware_threads(),
          .seed = run.seed,
          .enter_thread = [] { use_tensor_threads(1); },
          .evaluated =
              [&] {
                shared.control.checkpoint();
                const int now = ++evaluated;
                if (now % kEvaluationsAMessage != 0) return;
                shared.edit_status([&](RunStatus& status) {
                  status.message = format("learning what renders look like about the match: %d so far", now);
                });
              }};
}

std::vector<ChainState> ends_of(const std::vector<MapPoint>& basins, const Posterior& posterior) {
  std::vector<ChainState> ends;
  for (const MapPoint& basin : basins) ends.push_back({posterior.position(basin.values), {basin.lp, {}}});
  return ends;
}

std::vector<ChainState> starts_about(const Posterior& rough, const Posterior& posterior,
                                     const ChainState& mode, const std::vector<ChainState>& ends,
                                     const Metric& laplace, const EmulateSettings& settings,
                                     RunShared& shared) {
  const ControlledDensity roughly(rough, shared.control), target(posterior, shared.control);
  return emulator_starts(roughly, target, mode, ends, laplace, settings.seed, settings.threads,
                         settings.enter_thread);
}

/// moves_of_warmup() as the chains' files have them. @return [dimension, n]
Eigen::MatrixXd places_of_warmup(const Posterior& posterior, const std::filesystem::path& directory,
                                 const RunSettings& run) {
  const auto warmup = static_cast<std::size_t>(run.warmup.value());
  std::vector<std::vector<ChainCsvReader::Row>> rows;
  std::vector<std::vector<double>> log_densities;
  for (int chain = 0; chain < run.chains; ++chain) {
    rows.push_back(ChainCsvReader(chain_file(directory, chain)).read_new(warmup));
    rows.back().resize(std::min(rows.back().size(), warmup));
    auto& lp = log_densities.emplace_back();
    for (const ChainCsvReader::Row& row : rows.back()) lp.push_back(row.row.lp);
  }
  const std::vector<ChainIteration> moves = moves_of_warmup(log_densities);
  Eigen::MatrixXd places(posterior.dimension(), moves.size());
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const auto [chain, iteration] = moves[i];
    const Draw draw = to_draw(rows[static_cast<std::size_t>(chain)][iteration], posterior.table(), chain,
                              static_cast<std::int64_t>(iteration));
    places.col(static_cast<Eigen::Index>(i)) = posterior.position(draw.values).continuous;
  }
  return places;
}

}  // namespace

std::vector<std::string> run_kernel_names() {
  std::vector<std::string> names = kernel_names();
  names.insert(names.end(), {kEmulated, kAuto});
  return names;
}

bool emulates(const RunSettings& settings, const Posterior& posterior) {
  if (settings.kernel != kEmulated && settings.kernel != kAuto) return false;
  const std::string why_not = hindrance(settings, posterior);
  if (!why_not.empty() && settings.kernel == kEmulated)
    throw UserError("The kernel emulated " + why_not + ": use --kernel hmc.");
  return why_not.empty();
}

std::string kernel_in_use(const RunSettings& settings, bool emulated) {
  if (settings.kernel != kAuto) return settings.kernel;
  return emulated ? kEmulated : "hmc";
}

MetricKind metric_in_use(MetricKind asked, bool emulated) {
  return emulated && asked == MetricKind::curved ? MetricKind::dense : asked;
}

std::vector<ChainState> emulator_starts(const LogDensity& rough, const LogDensity& target,
                                        const ChainState& mode, const std::vector<ChainState>& basins,
                                        const Metric& laplace, std::uint64_t seed, int threads,
                                        const std::function<void()>& enter_thread) {
  std::vector<ChainState> starts = basins.empty() ? std::vector<ChainState>{mode} : basins;
  const std::size_t found = starts.size(), count = std::max<std::size_t>(found, kEmulatorWalkers);
  starts.resize(found + kStartsAWalker * (count - found));
  std::vector<ChainState> roughly;
  for (std::size_t i = 0; i < as_good(basins); ++i)
    roughly.push_back({starts[i].position, rough.value(starts[i].position)});
  const auto spread = [&](std::size_t i) {
    Rng rng(seed, kSpreadStream + i);
    starts[found + i] = overdispersed_start(rough, roughly[i % roughly.size()], laplace, rng);
  };
  parallel_for(starts.size() - found, threads, spread, enter_thread);
  starts = furthest_apart(starts, found, count, laplace.covariance().diagonal().cwiseSqrt());
  const auto climb = [&](std::size_t i) {
    Rng rng(seed, kNearerStream + i);
    ChainState& start = starts[found + i];
    std::optional<ChainState> climbed = climbed_start(target, mode, start.position);
    start = climbed ? std::move(*climbed) : overdispersed_start(target, mode, laplace, rng);
  };
  parallel_for(count - found, threads, climb, enter_thread);
  return starts;
}

std::vector<ChainState> followed_together(const LogDensity& target, std::vector<ChainState> ends) {
  constexpr double kTooDeep = 150;  // nats; along ridges, and from side to side, up to 62
  for (ChainState& end : ends) end.evaluation = target.value(end.position);
  sort_best_first(ends);
  const ChainState best = ends.front();
  std::erase_if(ends, [&](const ChainState& end) { return valley_between(target, best, end) > kTooDeep; });
  return ends;
}

Emulation learn_emulator(const Posterior& rough, const Posterior& posterior, const ChainState& mode,
                         const Metric& laplace, const std::vector<MapPoint>& basins, const RunSettings& run,
                         RunShared& shared) {
  std::atomic<int> evaluated{0};
  const EmulateSettings settings = learning(run, shared, evaluated);
  const std::vector<ChainState> ends = ends_of(basins, posterior);
  Emulation made = emulate(posterior, starts_about(rough, posterior, mode, ends, laplace, settings, shared),
                           laplace, settings);
  std::string why_not;
  if (!made.emulator)
    why_not =
        format("Polynomials do not follow the renders about this match (%.0f %% of proposals are taken)",
               100 * made.taken);
  else if (misses_one(*made.emulator, posterior.informed(), posterior, mode, ends))
    why_not = "There are other matches about as good, which polynomials about this one do not follow";
  if (why_not.empty()) return made;
  if (run.kernel == kEmulated) throw UserError(why_not + ": use --kernel hmc.");
  return {};
}

std::optional<AveragedEmulator> learn_average(const Posterior& rough, const Posterior& posterior,
                                              IrregularityPool& others, const Position& mode,
                                              const Metric& laplace, const std::vector<MapPoint>& basins,
                                              const RunSettings& run, RunShared& shared) {
  std::atomic<int> evaluated{0};
  EmulateSettings settings = learning(run, shared, evaluated);
  settings.others = &others;
  const std::vector<ChainState> ends = followed_together(posterior, ends_of(basins, posterior));
  settings.basins = as_good(ends, kAsGoodOnceWalked);
  const std::vector<ChainState> starts =
      starts_about(rough, posterior, {mode, posterior.value(mode)}, ends, laplace, settings, shared);
  std::optional<AveragedEmulator> made = emulate_average(posterior, starts, laplace, settings);
  if (!made && run.kernel == kEmulated)
    throw UserError("Polynomials do not follow the renders about this match: use --kernel hmc.");
  return made;
}

std::vector<ChainIteration> moves_of_warmup(const std::vector<std::vector<double>>& log_densities) {
  std::size_t warmup = 0;
  for (const std::vector<double>& lp : log_densities) warmup = std::max(warmup, lp.size());
  std::vector<ChainIteration> moves;
  for (std::size_t i = 0; i < warmup; ++i)
    for (std::size_t k = 0; k < log_densities.size(); ++k) {
      const std::vector<double>& lp = log_densities[k];
      if (i < lp.size() && (i == 0 || lp[i] != lp[i - 1])) moves.push_back({static_cast<int>(k), i});
    }
  return moves;
}

Emulator emulator_of_warmup(const Posterior& posterior, const KnownResiduals& known, const ChainState& mode,
                            const Metric& laplace, const std::filesystem::path& directory,
                            const RunSettings& run, RunShared& shared) {
  std::atomic<int> evaluated{0};
  const Eigen::MatrixXd places = places_of_warmup(posterior, directory, run);
  return emulate_about(posterior, places(posterior.informed(), Eigen::all), known, mode, laplace,
                       learning(run, shared, evaluated));
}

}  // namespace patina
