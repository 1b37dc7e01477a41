#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "engine/material/capture.h"
#include "engine/material/parameter.h"

namespace patina {

/// Everything that decides a run, beside the photo's pixels; run.json holds it.
struct RunSettings {
  std::string material = "bump";
  Capture capture;
  int resolution = 192;  ///< pixels a side at which renders are compared with the photo
  /// Empty: the material's own; run.json holds the name in use.
  std::string summary;
  std::filesystem::path network;  ///< empty: the bundled one
  std::string kernel = "hmc";
  std::string metric = "curved";   ///< what warm-up learns of the covariance: see metric_names()
  std::string discrete = "joint";  ///< what a discrete move proposes: joint or single (kernels.h)
  int chains = 4;
  int warmup = 1500;
  int draws = 4000;        ///< per chain, after warm-up
  double alpha = 0.8;      ///< probability of a continuous move, where there are discrete parameters
  double refresh = 0.75;   ///< probability that a continuous move refreshes one parameter instead (kernels.h)
  std::uint64_t seed = 1;  ///< of the search and the chains
  std::uint64_t z_seed = 1;  ///< of the irregularities
  bool map_only = false;     ///< stop after the search for the mode
  std::map<std::string, double> fixed;
  std::map<std::string, TruncatedNormal> priors;
};

}  // namespace patina
