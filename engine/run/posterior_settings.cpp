#include "engine/run/posterior_settings.h"

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

}  // namespace patina
