#include "engine/material/capture_priors.h"

#include <cmath>
#include <utility>

namespace patina {

ParameterTable table_under(ParameterTable table, const Capture& capture) {
  const double farther = capture.camera_cm / Capture().camera_cm;
  for (Parameter& parameter : table.continuous) {
    const double scale = std::pow(farther, std::exchange(parameter.camera_power, 0));
    TruncatedNormal& prior = parameter.prior;
    prior = {prior.mean * scale, prior.sd * scale, prior.low * scale, prior.high * scale};
  }
  return table;
}

}  // namespace patina
