#include "engine/run/run_alarms.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "engine/run/photo_alarms.h"
#include "engine/run/threads.h"
#include "engine/sampling/noise.h"

namespace patina {

Alarms run_alarms(const Image& photo, const Posterior& posterior, const Position& best) {
  Alarms alarms = photo_alarms(photo);
  const double noise =
      value_noise(posterior, best, kNoiseRepeats, hardware_threads(), [] { use_tensor_threads(1); });
  if (const auto alarm = noise_alarm(noise)) alarms.push_back(*alarm);
  if (const auto alarm = misfit_alarm(posterior.misfit(best))) alarms.push_back(*alarm);
  return alarms;
}

std::optional<Alarm> misfit_alarm(const std::vector<BlockMisfit>& misfits) {
  const auto worst = std::ranges::max_element(misfits, {}, &BlockMisfit::in_errors);
  if (worst == misfits.end() || !(worst->in_errors > kFar)) return std::nullopt;
  char text[256];
  if (worst->is_colour)
    std::snprintf(text, sizeof text, "its colours are off by %.0f of 255 levels, where a good match is off by %.0f",
                  255 * worst->distance, 255 * worst->distance / worst->in_errors);
  else
    std::snprintf(text, sizeof text, "its texture (%s) is off by %.0f %%, where a good match is off by %.0f %%",
                  worst->name.c_str(), 100 * worst->distance, 100 * worst->distance / worst->in_errors);
  return Alarm{"misfit", std::string("The best match is far from the photo: ") + text +
                             ". Intervals mean little: try another material, or check the size and the crop."};
}

}  // namespace patina
