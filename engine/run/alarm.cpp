#include "engine/run/alarm.h"

#include <cstdio>

#include "engine/sampling/noise.h"

namespace patina {

std::optional<Alarm> noise_alarm(double noise) {
  if (!(noise > kMostNoise)) return std::nullopt;
  char figure[32];
  std::snprintf(figure, sizeof figure, "%.2g", noise);
  return Alarm{"noise", std::string("The log density of one place is not the same twice (it scatters by ") +
                            figure +
                            " nats): intervals are too wide, and nothing in the draws shows by how much. "
                            "Report it, with the network and device in use."};
}

}  // namespace patina
