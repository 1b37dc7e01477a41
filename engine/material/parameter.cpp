#include "engine/material/parameter.h"

#include <algorithm>

namespace patina {

ParameterValues prior_location(const ParameterTable& table) {
  ParameterValues values;
  for (const Parameter& parameter : table.continuous)
    values.continuous.push_back(std::clamp(parameter.prior.mean, parameter.prior.low, parameter.prior.high));
  values.discrete.assign(table.discrete.size(), 0);
  return values;
}

}  // namespace patina
