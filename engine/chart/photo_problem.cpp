#include "engine/chart/photo_problem.h"

#include <algorithm>
#include <utility>

#include "engine/material/registry.h"
#include "engine/material/renderer.h"
#include "engine/posterior/emulated_moves.h"
#include "engine/posterior/irregularity_pool.h"
#include "engine/posterior/prior_transform.h"
#include "engine/posterior/simulate.h"
#include "engine/posterior/vetted_density.h"
#include "engine/posterior/wider_errors.h"
#include "engine/run/calibrated_errors.h"
#include "engine/run/emulated_proposals.h"
#include "engine/run/mode_search.h"
#include "engine/run/posterior_settings.h"
#include "engine/run/run_checks.h"
#include "engine/run/threads.h"
#include "engine/run/widened_errors.h"
#include "engine/sampling/best_first.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/map_search.h"
#include "engine/sampling/rng.h"
#include "engine/summary/precision.h"
#include "engine/summary/summary.h"

namespace patina {
namespace {

RunSettings with_summary(RunSettings settings) {
  if (settings.summary.empty()) settings.summary = material_table(settings.material).summary;
  return settings;
}

EmulateSettings learning(std::uint64_t seed, const std::function<void()>& evaluated) {
  return {.threads = hardware_threads(),
          .seed = seed,
          .enter_thread = [] { use_tensor_threads(1); },
          .evaluated = evaluated};
}

}  // namespace

PhotoProblem::PhotoProblem(const RunSettings& settings, Image photo, const std::string& description)
    : settings_(with_summary(settings)),
      photo_(std::move(photo)),
      posterior_(std::make_unique<Posterior>(posterior_settings(settings_, settings_.resolution), photo_)) {
  description_ = settings_.material + " at " + std::to_string(settings_.resolution) + " pixels, summary " +
                 settings_.summary + ", " + description;
}

std::vector<std::string> PhotoProblem::names() const {
  std::vector<std::string> names;
  for (const Parameter& parameter : posterior_->table().continuous) names.push_back(parameter.name);
  for (const DiscreteParameter& parameter : posterior_->table().discrete) names.push_back(parameter.name);
  return names;
}

std::vector<std::unique_ptr<LogDensity>> PhotoProblem::targets(const ChartSetting& setting) const {
  RunSettings settings = settings_;
  if (!setting.summary.empty()) settings.summary = setting.summary;
  if (setting.resolution > 0) settings.resolution = setting.resolution;
  settings.precision = setting.precision;
  std::vector<std::unique_ptr<LogDensity>> targets;
  for (const int level : pyramid(settings.resolution))
    targets.push_back(std::make_unique<Posterior>(search_settings(settings, level), photo_));
  return targets;
}

ChartProblem::Learnt PhotoProblem::learn(const ChartSetting&, std::uint64_t seed,
                                         const std::function<void()>& simulated) const {
  const auto match = [&] {
    Rng rng(seed, 0);
    MapSearchSettings search;
    search.threads = hardware_threads();
    search.enter_thread = [] { use_tensor_threads(1); };
    return search_map({posterior_.get()}, rng, search).best.position;
  };
  CalibratedMode found = learn_errors(*posterior_, photo_, settings_.capture, seed, simulated, match);
  return {std::make_unique<Posterior>(posterior_->with(found.errors.likelihood)), std::move(found.mode),
          std::move(found.laplace)};
}

std::optional<ChartProblem::Averaged> PhotoProblem::average(const ChartSetting& setting,
                                                            const std::vector<ChainState>& ends,
                                                            std::uint64_t seed,
                                                            const std::function<void()>& evaluated) const {
  const auto pool = make_pool(posterior_->table(), kSimulatedSeeds, kIrregularityPhotos);
  EmulateSettings settings = learning(seed, evaluated);
  settings.others = pool.get();
  const Simulator simulator{.posterior = *posterior_,
                            .pool = *pool,
                            .camera = {.least_side = 0},
                            .seed = seed,
                            .threads = settings.threads,
                            .enter_thread = settings.enter_thread,
                            .simulated = evaluated};
  const WiderErrors wider = errors_of_irregularities(simulator, ends.front().position);
  const Posterior widened = posterior_->with(wider);
  std::vector<Position> places;
  for (const ChainState& end : ends) places.push_back(end.position);
  std::vector<OptimizerResult> climbed = climb_on(widened, places);
  const Metric laplace(laplace_covariance(widened, climbed.front().position));
  const ChainState best{climbed.front().position, climbed.front().evaluation};
  for (OptimizerResult& image : climbed_images(widened, best, laplace, widened.of_either_sign()))
    climbed.push_back(std::move(image));

  const Posterior by_render = posterior_->with(wider.of_the_photo());
  std::vector<ChainState> found;
  for (const OptimizerResult& end : climbed) found.push_back({end.position, end.evaluation});
  const std::vector<ChainState> basins = followed_together(by_render, std::move(found));
  settings.basins = as_good(basins, kAsGoodOnceWalked);
  const std::vector<ChainState> starts = emulator_starts(
      by_render, by_render, basins.front(), basins, laplace, seed, settings.threads, settings.enter_thread);
  const auto made = emulate_average(by_render, starts, laplace, settings);
  if (!made) return std::nullopt;
  std::unique_ptr<VettedDensity> target = averaged(*posterior_, wider, *made);
  auto kernel = make_emulated_kernel(*target, setting.path_length);
  const Position& mode = climbed.front().position;
  ChainState begin{mode, target->evaluate(mode)};
  return Averaged{{std::move(target), std::move(begin), std::make_shared<const Metric>(made->covariance)},
                  std::move(kernel)};
}

Emulation PhotoProblem::emulate(const ChartSetting&, const std::vector<ChainState>& starts,
                                const Metric& laplace, std::uint64_t seed,
                                const std::function<void()>& evaluated) const {
  return patina::emulate(*posterior_, starts, laplace, learning(seed, evaluated));
}

Emulator PhotoProblem::emulate_about(const ChartSetting&, const Eigen::MatrixXd& places,
                                     const KnownResiduals& known, const ChainState& mode,
                                     const Metric& laplace, std::uint64_t seed,
                                     const std::function<void()>& evaluated) const {
  return patina::emulate_about(*posterior_, places(informed(), Eigen::all), known, mode, laplace,
                               learning(seed, evaluated));
}

std::vector<Eigen::Index> PhotoProblem::informed() const { return posterior_->informed(); }

Eigen::VectorXd PhotoProblem::values(const Position& position) const {
  const ParameterValues values = posterior_->values(position);
  return Eigen::Map<const Eigen::VectorXd>(values.continuous.data(), std::ssize(values.continuous));
}

void PhotoProblem::use_threads(int count) const { use_tensor_threads(count); }

ChartTarget PhotoProblem::target() const {
  const auto summary = make_summary(settings_.summary, settings_.network);
  const int levels = levels_of(*summary);
  return {settings_.summary,
          settings_.resolution,
          std::max(summary->minimum_resolution(), kLeastResolution),
          has_jagged(*posterior_),
          !posterior_->discrete_levels().empty(),
          true,
          levels > 0 && bfloat16_pays(),
          levels,
          can_emulate(*posterior_),
          can_emulate(*posterior_) && has_jagged(*posterior_)};
}

Image photo_of_prior_draw(const RunSettings& settings, std::uint64_t seed, std::uint64_t z_seed) {
  constexpr int kSide = 256;  // pixels
  const Renderer renderer(settings.material, z_seed, settings.capture);
  Rng rng(seed);
  const ParameterTable& table = renderer.table();
  ParameterValues values{values_at(table, rng.normals(std::ssize(table.continuous))), {}};
  for (const DiscreteParameter& choice : table.discrete)
    values.discrete.push_back(rng.below(static_cast<int>(choice.levels.size())));
  return renderer.render(values, kSide);
}

}  // namespace patina
