#include "engine/run/alarm.h"

#include "engine/format.h"
#include "engine/sampling/noise.h"

namespace patina {

std::optional<Alarm> noise_alarm(double noise) {
  if (!(noise > kMostNoise)) return std::nullopt;
  return Alarm{"noise", "The log density of one place is not the same twice (it scatters by " +
                            format("%.2g", noise) +
                            " nats): intervals are too wide, and nothing in the draws shows by how much. "
                            "Report it, with the network and device in use."};
}

}  // namespace patina
