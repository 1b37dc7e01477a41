#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "engine/material/capture.h"
#include "engine/material/parameter.h"

namespace patina {

/// When a run ends before all its draws are made. They decide how many draws there are, never which.
struct StopRules {
  double minutes = 0;  ///< of one sitting, the search included; 0: no limit
  double ess = 0;      ///< effective draws, bulk and tail, of every identified parameter; 0: not asked for
  double rhat = 0;     ///< of every identified parameter, at most; 0: not asked for
  bool ask_for_quality() const { return ess > 0 || rhat > 0; }
  bool operator==(const StopRules&) const = default;
};

/// The kernel of a run whose proposals come from an emulator (engine/posterior/emulator.h).
inline constexpr const char* kEmulated = "emulated";
/// Of kernels: that one where it can be, hmc elsewhere; of errors: see RunSettings::errors.
inline constexpr const char* kAuto = "auto";

/// Pixels a side where nothing but the best match is asked for: no chains pay for them, and what is fine
/// comes nearer (resources/fits). Chains of jagged materials agree sooner at fewer.
inline constexpr int kMatchResolution = 256;

/// Everything that decides a run, beside the photo's pixels; run.json holds it.
struct RunSettings {
  std::string material = "bump";
  Capture capture;
  int resolution = 192;  ///< pixels a side at which renders are compared with the photo
  /// Empty: the material's own; run.json holds the name in use.
  std::string summary;
  std::filesystem::path network;      ///< empty: the bundled one
  std::string precision = "float32";  ///< of its convolutions (engine/summary/precision.h)
  std::string device = "cpu";         ///< that it runs on (engine/summary/device.h)

  /// What renders may be off by, of asked_error_names(). "paper": set by hand. "averaged": and by what a
  /// photo's irregularities do at the best match, renders being averaged over theirs
  /// (posterior/vetted_density.h), or, where proposals are not emulated, by what both do
  /// (posterior/wider_errors.h). "calibrated": learnt from simulated photos (posterior/calibrate.h). "auto":
  /// averaged where proposals are emulated and the material has irregularities that gradients do not move,
  /// else paper; Manifest::errors tells which.
  std::string errors = kAuto;
  std::string kernel = kAuto;      ///< of run_kernel_names(); Manifest::kernel tells what "auto" came to
  std::string metric = "curved";   ///< what warm-up learns of the covariance: see metric_in_use()
  std::string discrete = "joint";  ///< what a discrete move proposes: joint or single (kernels.h)
  int chains = 4;
  /// Warm-up iterations of each chain. Empty: usual_warmup(); run.json holds the number. With
  /// emulated proposals kEmulatedWarmup, of an average kAveragedWarmup at most: Manifest::warmup tells.
  std::optional<int> warmup;
  int draws = 10000;   ///< per chain, after warm-up, at most: `stop` may end a run before
  double alpha = 0.8;  ///< probability of a continuous move, where there are discrete parameters
  /// Probability that a continuous move refreshes one parameter instead (kernels.h). Empty:
  /// usual_refresh(); run.json holds the one in use.
  std::optional<double> refresh;
  double path_length = 1.5;  ///< of hmc's trajectories, in standard deviations (kernels.h)
  /// Rungs of every chain's ladder from prior to posterior, see sampling/tempering.h; 0: chains by
  /// themselves.
  int temper = 0;
  int rungs() const { return temper == 0 ? 1 : temper; }
  /// Where chains begin (chain_start.h): "map", spread about the best match; "predict", where the material's
  /// predictor guesses, without a global search; "prior", a draw of the prior for each; "prior-mean", all at
  /// the priors' means; "values", all at start_at.
  std::string start = "map";
  std::map<std::string, double> start_at;  ///< parameter values by name; the others at the priors' means
  std::uint64_t seed = 1;                  ///< of the search and the chains
  std::uint64_t z_seed = 1;                ///< of the irregularities
  bool map_only = false;                   ///< stop after the search for the mode
  /// By default the usual demands on draws that are to be trusted (Vehtari et al. 2021), and the patience of
  /// someone who waits; a run that ends before all its draws are made can be continued.
  StopRules stop = {.minutes = 9, .ess = 400, .rhat = 1.01};
  std::map<std::string, double> fixed;
  std::map<std::string, TruncatedNormal> priors;

  bool operator==(const RunSettings&) const = default;
};

}  // namespace patina
