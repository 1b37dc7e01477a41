#pragma once

#include <cstdint>
#include <limits>

#include "engine/material/parameter.h"

namespace patina {

/// One draw of one chain, as it crosses from a sampler to whoever reads it. Plain numbers, no tensor.
struct Draw {
  int chain = 0;               ///< from 0
  std::int64_t iteration = 0;  ///< from 0 within the chain, warm-up included
  bool warmup = false;
  double lp = -std::numeric_limits<double>::infinity();  ///< log posterior density, constants dropped
  /// Of the trajectory that made it, kinetic energy included; -lp of a move without one; NaN: not known.
  double energy = std::numeric_limits<double>::quiet_NaN();
  double accept_stat = 0;
  double step_size = 0;
  bool divergent = false;
  ParameterValues values;  ///< parameter units
};

}  // namespace patina
