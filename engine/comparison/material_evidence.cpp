#include "engine/comparison/material_evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/material/registry.h"
#include "engine/run/controlled_density.h"
#include "engine/run/predicted_start.h"
#include "engine/run/stopwatch.h"
#include "engine/run/threads.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/map_search.h"
#include "engine/sampling/optimizer.h"
#include "engine/sampling/parallel_for.h"
#include "engine/sampling/sequential.h"
#include "engine/summary/summary.h"

namespace patina {
namespace {

/// The search begins at half as many pixels a side.
int coarser(int resolution) { return std::max(resolution / 2, kLeastRankResolution); }

PosteriorSettings posterior_settings(const std::string& material, const RankSettings& settings,
                                     int resolution) {
  PosteriorSettings posterior;
  posterior.material = material;
  posterior.capture = settings.capture;
  posterior.resolution = resolution;
  posterior.summary = settings.summary;
  posterior.network = settings.network;
  posterior.z_seed = settings.z_seed;
  posterior.priors = camera_priors(material, settings.capture);
  return posterior;
}

/// Half the chi-square that the hand-set errors stand for (error_model.h): half a nat for the whole of a Gram
/// matrix or a spectrum, and for each of the 12 mean colours that regional errors were set for.
double expected_misfit(const RankSettings& settings) {
  double expected = 0;
  for (const SummaryBlock& block : make_summary(settings.summary, settings.network)->blocks())
    expected += block.scale == ErrorScale::regional ? 6 : 0.5 / block.views;
  return expected;
}

double half_chi_square(const Evaluation& at, const Position& position) {
  return -(at.log_density + 0.5 * position.continuous.squaredNorm());
}

}  // namespace

std::map<std::string, TruncatedNormal> camera_priors(const std::string& material, const Capture& capture) {
  const ParameterTable table = material_table(material);
  const double away = capture.camera_cm / Capture{}.camera_cm;
  std::map<std::string, TruncatedNormal> priors;
  if (const auto light = table.find_continuous("light")) {
    const double mean = away * away * table.continuous[*light].prior.mean;
    priors["light"] = {mean, 0.6 * mean, 0.02 * mean, 3 * mean};
  }
  if (table.find_continuous("iSigma")) priors["iSigma"] = {15 * away, 3 * away, 5 * away, 20 * away};
  return priors;
}

MaterialEvidence::MaterialEvidence(const std::string& material, const RankSettings& settings,
                                   const Image& photo, double glance)
    : settings_(settings),
      photo_(photo),
      coarse_(posterior_settings(material, settings, coarser(settings.resolution)), photo),
      posterior_(posterior_settings(material, settings, settings.resolution), photo),
      glance_(glance),
      best_(posterior_.position(prior_location(posterior_.table()))),
      expected_misfit_(expected_misfit(settings)) {}

void MaterialEvidence::search(int threads, RunControl& control, const std::function<void(double)>& progress) {
  const Stopwatch stopwatch(seconds_);
  const ControlledDensity coarse(coarse_, control), target(posterior_, control);
  MapSearchSettings search;
  search.prior_draws = 64;
  search.descents = 8;
  search.finalists = 3;
  search.guesses = predicted_guesses(coarse_, photo_, settings_.capture, settings_.seed);
  search.threads = threads;
  search.enter_thread = [] { use_tensor_threads(1); };
  search.progress = [&](double fraction, const Position&, double) { progress(fraction); };
  Rng rng(settings_.seed, 0);
  const MapSearchResult result = search_map({&coarse, &target}, rng, search);
  best_ = result.best.position;
  misfit_ = half_chi_square(result.best.evaluation, best_);
  std::vector<NormalBasin> basins;
  for (const OptimizerResult& basin : result.basins)
    if (std::isfinite(basin.evaluation.log_density))
      basins.push_back({{basin.position, basin.evaluation}, laplace_covariance(target, basin.position)});
  evidence_ = {laplace_log_evidence(basins, target.discrete_levels()),
               std::numeric_limits<double>::quiet_NaN()};
}

void MaterialEvidence::measure(int threads, RunControl& control,
                               const std::function<void(double)>& progress) {
  const Stopwatch stopwatch(seconds_);
  const ControlledDensity target(posterior_, control);
  // Islands whose particles remember where they stood may agree by chance. Runs by another seed were off by
  // half a nat (root mean square over sqrt 2 of six pairs, one of them 1.7 apart; resources/compare).
  constexpr double kRemembered = 0.6, kLeastThen = 1;
  SequentialSettings sequential;
  sequential.particles = settings_.particles;
  sequential.correlation = 0.3;
  sequential.most_moves = 24;
  sequential.seed = settings_.seed;
  sequential.threads = threads;
  sequential.enter_thread = [] { use_tensor_threads(1); };
  sequential.reached = progress;
  const auto kernel = make_kernel("mala", target, 0.8, 0.25);
  const SequentialResult found = sample_sequentially(target, *kernel, sequential);
  evidence_ = found.evidence;
  if (found.worst_correlation > kRemembered) evidence_.error = std::max(evidence_.error, kLeastThen);
}

void MaterialEvidence::foretell(int threads, RunControl& control,
                                const std::function<void(double)>& progress) {
  const Stopwatch stopwatch(seconds_);
  if (settings_.resolution >= 2 * make_summary(settings_.summary, settings_.network)->minimum_resolution()) {
    std::vector<Posterior> quarters;
    for (int quarter = 0; quarter < 4; ++quarter) quarters.push_back(posterior_.of_quarter(quarter, photo_));
    quarters_.assign(quarters.size(), 0);
    OptimizerSettings climb;
    climb.max_iterations = 20;
    const auto one = [&](std::size_t q) {
      const ControlledDensity seen(quarters[3 - q], control), unseen(quarters[q], control);
      const Position match = maximize(seen, best_, climb).position;
      quarters_[q] = -half_chi_square(unseen.value(match), match);
    };
    parallel_for(quarters.size(), threads, one, [] { use_tensor_threads(1); });
  }
  progress(1);
}

void MaterialEvidence::compare_samples() {
  constexpr int kSamples = 3;
  const Eigen::VectorXd own = posterior_.predicted(best_);
  double total = 0;
  for (int i = 1; i <= kSamples; ++i) {
    RankSettings other = settings_;
    other.z_seed += static_cast<std::uint64_t>(i);
    const Posterior sample(posterior_settings(posterior_.table().material, other, other.resolution), photo_);
    total += 0.5 * (sample.predicted(best_) - own).squaredNorm() / kSamples;
  }
  misfit_of_another_sample_ = std::sqrt(total / expected_misfit_);
}

RankedMaterial MaterialEvidence::ranked() const {
  const ParameterTable& table = posterior_.table();
  RankedMaterial ranked;
  ranked.material = table.material;
  ranked.parameters = static_cast<int>(table.continuous.size() + table.discrete.size());
  ranked.log_evidence = evidence_.value;
  if (std::isfinite(evidence_.error)) ranked.error = evidence_.error;
  ranked.quarters = quarters_;
  ranked.glance = glance_;
  ranked.match = posterior_.values(best_);
  ranked.misfit = std::sqrt(misfit_ / expected_misfit_);
  ranked.misfit_of_another_sample = misfit_of_another_sample_;
  ranked.seconds = seconds_;
  return ranked;
}

}  // namespace patina
