#pragma once

#include <functional>
#include <limits>
#include <string>

#include "engine/sampling/log_density.h"

namespace patina {

struct OptimizerSettings {
  int max_iterations = 100;
  double gradient_tolerance = 1e-3;  ///< stop when |gradient| < tolerance * max(1, |x|)
  double value_tolerance = 1e-5;  ///< stop when the value improved by less, relatively, over five iterations
  double good_enough = std::numeric_limits<double>::infinity();  ///< stop at this log density
  double hopeless = -std::numeric_limits<double>::infinity();    ///< stop below this one half-way
  std::function<bool()> stop_requested;                          ///< asked once per iteration; empty: never
};

struct OptimizerResult {
  Position position;
  Evaluation evaluation;
  int evaluations = 0;
  std::string stopped_because;  ///< in words
};

/// Climbs to a local maximum over the continuous coordinates, discrete ones held: L-BFGS with a line search
/// for the strong Wolfe conditions (liblbfgs). Jagged coordinates are held as well: no line search ends
/// there. Never returns a point worse than the start.
OptimizerResult maximize(const LogDensity& target, const Position& start,
                         const OptimizerSettings& settings = {});

}  // namespace patina
