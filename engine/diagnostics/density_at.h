#pragma once

#include "engine/diagnostics/convergence.h"

namespace patina {

struct DensityEstimate {
  double value = 0;
  double error = 0;  ///< Monte Carlo standard error
};

/// The density of draws in [0, 1] at a point of that interval, from the share of draws nearby: the mean over
/// both sides inside, the linear extrapolation of two windows at an end (errors of second order in the
/// width). Where 0 and 1 are the ends of a prior's cdf it is the Savage-Dickey ratio (Dickey 1971): how many
/// times likelier the point is after the data than before.
/// @param draws  iterations x chains, in [0, 1]   @param width  of a window, below 0.25
DensityEstimate density_at(ChainDraws draws, double point, double width = 0.05);

}  // namespace patina
