#include "engine/run/material_evidence.h"

#include <cmath>
#include <limits>
#include <map>

#include "engine/material/registry.h"
#include "engine/run/controlled_density.h"
#include "engine/run/stopwatch.h"
#include "engine/run/threads.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/map_search.h"
#include "engine/sampling/sequential.h"

namespace patina {
namespace {

constexpr int kCoarser = 2;  ///< the search begins at so many times fewer pixels a side

std::map<std::string, TruncatedNormal> camera_priors(const std::string& material, const Capture& capture) {
  const ParameterTable table = material_table(material);
  std::map<std::string, TruncatedNormal> priors;
  if (const auto light = table.find_continuous("light")) {
    const double exposure = std::pow(capture.camera_cm / Capture{}.camera_cm, 2);
    const double mean = exposure * table.continuous[*light].prior.mean;
    priors["light"] = {mean, 0.6 * mean, 0.02 * mean, 3 * mean};
  }
  if (table.find_continuous("iSigma")) priors["iSigma"] = {15, 3, 5, 20};
  return priors;
}

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

}  // namespace

MaterialEvidence::MaterialEvidence(const std::string& material, const RankSettings& settings,
                                   const Image& photo)
    : settings_(settings),
      coarse_(posterior_settings(material, settings, settings.resolution / kCoarser), photo),
      posterior_(posterior_settings(material, settings, settings.resolution), photo) {}

void MaterialEvidence::search(int threads, RunControl& control, const std::function<void(double)>& progress) {
  const Stopwatch stopwatch(seconds_);
  const ControlledDensity coarse(coarse_, control), target(posterior_, control);
  MapSearchSettings search;
  search.prior_draws = 64;
  search.descents = 8;
  search.finalists = 3;
  search.threads = threads;
  search.enter_thread = [] { use_tensor_threads(1); };
  search.progress = [&](double fraction, const Position&, double) { progress(fraction); };
  Rng rng(settings_.seed, 0);
  const MapSearchResult result = search_map({&coarse, &target}, rng, search);
  best_ = result.best.position;
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
  SequentialSettings sequential;
  sequential.particles = 32;
  sequential.correlation = 0.3;
  sequential.most_moves = 24;
  sequential.seed = settings_.seed;
  sequential.threads = threads;
  sequential.enter_thread = [] { use_tensor_threads(1); };
  sequential.reached = progress;
  const auto kernel = make_kernel("mala", target, 0.8, 0.25);
  evidence_ = sample_sequentially(target, *kernel, sequential).evidence;
}

RankedMaterial MaterialEvidence::ranked() const {
  const ParameterTable& table = posterior_.table();
  RankedMaterial ranked;
  ranked.material = table.material;
  ranked.parameters = static_cast<int>(table.continuous.size() + table.discrete.size());
  ranked.log_evidence = evidence_.value;
  ranked.error = evidence_.error;
  ranked.match = posterior_.values(best_);
  ranked.seconds = seconds_;
  return ranked;
}

}  // namespace patina
