#include "engine/run/posterior_settings.h"

#include "engine/summary/device.h"
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
  // Whoever looks at a run need not have the card that made it; check_settings() asks for that.
  if (is_at_hand(device_named(settings.device))) posterior.device = settings.device;
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
