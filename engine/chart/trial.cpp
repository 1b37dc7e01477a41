#include "engine/chart/trial.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "engine/chart/metered_density.h"
#include "engine/error.h"
#include "engine/posterior/emulated_moves.h"
#include "engine/run/chain_start.h"
#include "engine/run/emulated_proposals.h"
#include "engine/run/mode_search.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/map_search.h"
#include "engine/sampling/sample.h"

namespace patina {
namespace {

using Clock = Meter::Clock;

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

double processor_seconds() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
}

Clock::time_point deadline(Clock::time_point start, double seconds) {
  if (seconds <= 0) return Clock::time_point::max();
  return start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

/// One trial under way. What has been seen when time is over stays.
class Running {
 public:
  Running(const ChartProblem& problem, const ChartSetting& setting, const TrialPlan& plan, Trial& trial)
      : problem_(problem),
        setting_(setting),
        plan_(plan),
        trial_(trial),
        meter_(deadline(start_, plan.seconds)) {
    trial_.chains.resize(static_cast<std::size_t>(setting.chains));
    warmup_.resize(trial_.chains.size());
  }

  /// @throws OutOfTime
  void run() {
    if (setting_.errors == "calibrated") return learn_and_draw();
    for (const auto& target : targets_) metered_.push_back(std::make_unique<MeteredDensity>(*target, meter_));
    const MapSearchResult found = search();
    for (const OptimizerResult& basin : found.basins) basins_.push_back({basin.position, basin.evaluation});
    if (setting_.errors == "averaged" && average_and_draw()) return;
    const LogDensity& target = *metered_.back();
    const Metric laplace(laplace_covariance(target, found.best.position));
    end_search();
    const ChainState mode{found.best.position, found.best.evaluation};
    const std::unique_ptr<Kernel> kernel = this->kernel(target, mode, laplace);
    const bool short_of_it = made_.emulator && !has_jagged(target);
    draw(target, mode, laplace, *kernel,
         short_of_it ? std::min(setting_.warmup, kEmulatedWarmup) : setting_.warmup);
  }

  void end() {
    trial_.seconds = elapsed();
    trial_.processor_seconds = processor_seconds() - processor_start_;
    trial_.evaluations = meter_.evaluations();
    trial_.value_evaluations = meter_.values();
  }

 private:
  double elapsed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  MapSearchResult search() {
    problem_.use_threads(plan_.threads);
    std::vector<const LogDensity*> targets;
    for (const auto& target : metered_) targets.push_back(target.get());
    MapSearchSettings settings =
        setting_.errors == "averaged" ? search_before_average() : MapSearchSettings{};
    settings.threads = plan_.threads;
    settings.enter_thread = [&] { problem_.use_threads(1); };
    settings.progress = [&](double, const Position& best, double) {
      trial_.search.push_back({elapsed(), problem_.values(best)});
    };
    Rng rng(plan_.seed, 0);
    MapSearchResult found = search_map(targets, rng, settings);
    if (!std::isfinite(found.best.evaluation.log_density))
      throw UserError("No parameters render to anything comparable with the photo.");
    trial_.search.push_back({elapsed(), problem_.values(found.best.position)});
    return found;
  }

  void learn_and_draw() {
    problem_.use_threads(plan_.threads);
    const ChartProblem::Learnt learnt = problem_.learn(setting_, plan_.seed, [&] { meter_.count(false); });
    trial_.search.push_back({elapsed(), problem_.values(learnt.mode.position)});
    end_search();
    const MeteredDensity target(*learnt.target, meter_);
    draw(target, learnt.mode, *learnt.laplace, *problem_.kernel(setting_, target), setting_.warmup);
  }

  /// @return  whether there is an average; where there is none, a run draws by hand-set errors
  bool average_and_draw() {
    end_search();
    averaged_ =
        problem_.average(setting_, basins_, plan_.seed, [&] { meter_.count(/*with_gradient=*/false); });
    if (!averaged_) return false;
    const auto& [learnt, kernel] = *averaged_;
    draw(MeteredDensity(*learnt.target, meter_), learnt.mode, *learnt.laplace, *kernel,
         std::min(setting_.warmup, kAveragedWarmup));
    return true;
  }

  void end_search() {
    trial_.search_seconds = elapsed();
    trial_.search_evaluations = meter_.evaluations();
  }

  void draw(const LogDensity& target, const ChainState& mode, const Metric& laplace, const Kernel& kernel,
            int warmup) {
    SampleSettings settings;
    settings.chains = setting_.chains;
    settings.warmup = warmup;
    settings.draws = plan_.draws;
    settings.seed = plan_.seed;
    settings.metric_worth = 10.0 * static_cast<double>(target.dimension());  // as a run has it
    settings.threads = setting_.chains;
    settings.noise_repeats = 0;  // they are no part of what a setting costs
    settings.enter_thread = [&] { problem_.use_threads(1); };
    settings.warmed_up = [&](const KernelSettings&) {
      trial_.warmup_seconds = elapsed() - trial_.search_seconds;
      trial_.warmup_evaluations = meter_.evaluations() - trial_.search_evaluations;
    };
    settings.warmed = [&](int chain, const ChainState& state) {
      if (made_.emulator) warmup_[static_cast<std::size_t>(chain)].push_back(state);
    };
    settings.drew = [&](int chain, const ChainState& state) {
      TrialChain& trace = trial_.chains[static_cast<std::size_t>(chain)];
      trace.values.push_back(problem_.values(state.position));
      trace.levels.push_back(state.position.discrete);
      trace.seconds.push_back(elapsed());
    };
    const auto start = [&](Rng& rng) {
      if (setting_.start == "prior")
        return start_at(
                   target, [&](Rng& r) { return prior_draw(target, r); }, rng)
            .position;
      return overdispersed_start(target, mode, laplace, rng).position;
    };
    settings.metric = metric_in_use(metric_kind(setting_.metric), made_.emulator || averaged_);
    const Metric first(restricted(laplace.covariance(), settings.metric));
    std::unique_ptr<Kernel> again;
    settings.kernel_of_draws = [&]() -> const Kernel& {
      again = kernel_of_warmup(target, mode, laplace);
      return again ? *again : kernel;
    };
    sample(target, kernel, settings, start, first);
  }

  /// Where the setting's is emulated and cannot be, hmc, as a run has it.
  std::unique_ptr<Kernel> kernel(const LogDensity& target, const ChainState& mode, const Metric& laplace) {
    if (setting_.proposals != 0) return two_stage();
    if (setting_.kernel != kEmulated) return problem_.kernel(setting_, target);
    const std::vector<ChainState> starts =
        emulator_starts(*metered_.front(), target, mode, basins_, laplace, plan_.seed, plan_.threads,
                        [&] { problem_.use_threads(1); });
    made_ = problem_.emulate(setting_, starts, laplace, plan_.seed, [&] { meter_.count(false); });
    const std::vector<Eigen::Index> informed = problem_.informed();
    if (made_.emulator && misses_one(*made_.emulator, informed, target, mode, basins_))
      made_.emulator.reset();
    if (made_.emulator) return make_emulated_kernel(*made_.emulator, informed, target, setting_.path_length);
    ChartSetting hmc = setting_;
    hmc.kernel = "hmc";
    return problem_.kernel(hmc, target);
  }

  /// Of proposals that are learnt again, as a run does; none where there was no warm-up or its are not
  /// emulated.
  std::unique_ptr<Kernel> kernel_of_warmup(const LogDensity& target, const ChainState& mode,
                                           const Metric& laplace) {
    if (!made_.emulator || setting_.warmup == 0) return nullptr;
    std::vector<std::vector<double>> log_densities;
    for (const std::vector<ChainState>& chain : warmup_) {
      auto& lp = log_densities.emplace_back();
      for (const ChainState& state : chain) lp.push_back(state.evaluation.log_density);
    }
    const std::vector<ChainIteration> moves = moves_of_warmup(log_densities);
    Eigen::MatrixXd places(target.dimension(), moves.size());
    for (std::size_t i = 0; i < moves.size(); ++i)
      places.col(static_cast<Eigen::Index>(i)) =
          warmup_[static_cast<std::size_t>(moves[i].chain)][moves[i].iteration].position.continuous;
    const Emulator again = problem_.emulate_about(setting_, places, made_.known, mode, laplace, plan_.seed,
                                                  [&] { meter_.count(false); });
    return make_emulated_kernel(again, problem_.informed(), target, setting_.path_length);
  }

  /// The setting's kernel on the posterior that proposes; the caller's target decides.
  std::unique_ptr<Kernel> two_stage() {
    ChartSetting coarse = setting_;
    coarse.resolution = setting_.proposals;
    proposer_ = std::move(problem_.targets(coarse).back());
    metered_.push_back(std::make_unique<MeteredDensity>(*proposer_, meter_));
    const LogDensity& cheap = *metered_.back();
    return make_two_stage(problem_.kernel(setting_, cheap), cheap, kMovesAProposal);
  }

  const ChartProblem& problem_;
  const ChartSetting& setting_;
  const TrialPlan& plan_;
  Trial& trial_;
  Clock::time_point start_ = Clock::now();
  double processor_start_ = processor_seconds();
  Meter meter_;
  std::vector<std::unique_ptr<LogDensity>> targets_ = problem_.targets(setting_);
  std::unique_ptr<LogDensity> proposer_;  ///< where there are two stages
  std::vector<std::unique_ptr<MeteredDensity>> metered_;
  std::vector<ChainState> basins_;  ///< that the search ended in
  Emulation made_;                  ///< of warm-up
  std::optional<ChartProblem::Averaged> averaged_;
  std::vector<std::vector<ChainState>> warmup_;  ///< each chain's, where there is an emulator
};

template <typename Vector>
std::vector<Eigen::MatrixXd> matrices(const std::vector<TrialChain>& chains, std::size_t draws,
                                      std::vector<Vector> TrialChain::*of) {
  std::vector<Eigen::MatrixXd> result;
  if (draws == 0) return result;
  const Eigen::Index quantities = (chains.front().*of).front().size();
  for (Eigen::Index q = 0; q < quantities; ++q) {
    Eigen::MatrixXd& matrix = result.emplace_back(draws, chains.size());
    for (std::size_t k = 0; k < chains.size(); ++k)
      for (std::size_t i = 0; i < draws; ++i) matrix(i, k) = static_cast<double>((chains[k].*of)[i][q]);
  }
  return result;
}

}  // namespace

Eigen::Index QuantityDraws::draws() const {
  if (!continuous.empty()) return continuous.front().rows();
  return discrete.empty() ? 0 : discrete.front().rows();
}

QuantityDraws Trial::draws() const {
  std::size_t shortest = chains.empty() ? 0 : chains.front().seconds.size();
  for (const TrialChain& chain : chains) shortest = std::min(shortest, chain.seconds.size());
  return {matrices(chains, shortest, &TrialChain::values), matrices(chains, shortest, &TrialChain::levels)};
}

Trial run_trial(const ChartProblem& problem, const ChartSetting& setting, const TrialPlan& plan) {
  Trial trial;
  Running running(problem, setting, plan, trial);
  try {
    running.run();
  } catch (const OutOfTime&) {
    // What there is by then is what the setting is worth in that time.
  }
  running.end();
  return trial;
}

}  // namespace patina
