#include "engine/run/posterior_settings.h"

#include "engine/summary/summary_name.h"

namespace patina {

PosteriorSettings posterior_settings(const RunSettings& settings, int resolution) {
  PosteriorSettings posterior;
  posterior.material = settings.material;
  posterior.capture = settings.capture;
  posterior.resolution = resolution;
  posterior.summary = settings.summary;
  posterior.network = settings.network;
  posterior.precision = settings.precision;
  posterior.z_seed = settings.z_seed;
  posterior.fixed = settings.fixed;
  posterior.priors = settings.priors;
  return posterior;
}

PosteriorSettings search_settings(const RunSettings& settings, int level) {
  PosteriorSettings posterior = posterior_settings(settings, level);
  if (level < settings.resolution) posterior.summary = without_covariances(posterior.summary);
  return posterior;
}

}  // namespace patina
