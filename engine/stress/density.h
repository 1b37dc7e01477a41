#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/sampling/function_density.h"
#include "engine/sampling/sample.h"
#include "engine/stress/scenario.h"

namespace patina {

/// A posterior in prior-CDF coordinates, of which some quantities are known.
struct KnownPosterior {
  std::shared_ptr<const LogDensity> target;
  ParameterTable table;
  std::function<ParameterValues(const Position&)> values;
  std::vector<Known> known;
};

/// How a density is drawn from. What is not said is as a run has it (RunSettings).
struct Demand {
  int chains = 4, warmup = 600, draws = 2500;
  double refresh = 0.75;
  /// Where chains begin; empty: as a run's do, about the mode that a search finds.
  Start start = {};
  double metric_factor = 1;  ///< by which the sds that warm-up begins with are wrong
};

using Posed = std::function<KnownPosterior()>;

/// Search for the mode, Laplace's metric, start, warm-up, draws, summary: a run in memory.
Scenario density_scenario(std::string name, std::string what, std::string known_by, Posed pose,
                          Demand demand = {});

/// A posterior whose parameters are its coordinates, named x1, x2 ...; their levels c1, c2 ...
KnownPosterior in_coordinates(Eigen::Index dimension, FunctionDensity::Function function,
                              std::vector<int> levels = {});

/// The i-th parameter, continuous or discrete, with its mean and sd.
Known parameter(const KnownPosterior& posterior, std::size_t index, double mean, double sd);
Known choice(const KnownPosterior& posterior, std::size_t index, int level, double probability);

}  // namespace patina
