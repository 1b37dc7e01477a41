#pragma once

#include <string>
#include <vector>

namespace patina {

/// One way of drawing from a posterior: a point of the chart. What `resolution`, `summary`, `precision` and
/// `errors` change is the posterior itself; it is judged by the target's all the same, so that what they bias
/// shows as error.
struct ChartSetting {
  std::string name;    ///< as it stands at the point; without comma and line break
  std::string kernel;  ///< of run_kernel_names() (engine/run/emulated_proposals.h)
  std::string metric;
  std::string discrete;
  std::string start;      ///< "map" or "prior" (engine/run/chain_start.h)
  std::string errors;     ///< of error_names() (engine/run/run_checks.h)
  std::string summary;    ///< empty: the target's
  std::string precision;  ///< of precision_names() (engine/summary/precision.h)
  int resolution = 0;     ///< pixels a side; 0: the target's
  int chains = 0;
  int warmup = 0;  ///< iterations of each chain
  double alpha = 0, refresh = 0, path_length = 0;
  int proposals =
      0;  ///< pixels a side of the posterior that proposes (make_two_stage); 0: there is one stage
  bool operator==(const ChartSetting&) const = default;
};

/// Transitions that make a proposal, where another posterior proposes.
inline constexpr int kMovesAProposal = 4;

inline constexpr const char* kDefaultSetting = "default";
inline constexpr const char* kHandSet = "hand-set errors";

/// What of a target decides which settings make sense.
struct ChartTarget {
  std::string summary = {};
  int resolution = 0;
  int least_resolution = 0;  ///< that its summary can look at
  bool has_jagged = false;   ///< see LogDensity::jagged()
  bool has_discrete = false;
  bool can_learn = false;    ///< see ChartProblem::learn()
  bool can_round = false;    ///< it has a network, and bfloat16_pays()
  int levels = 0;            ///< of its network; 0: it has none
  bool can_emulate = false;  ///< see ChartProblem::emulate()
  bool can_average = false;  ///< see ChartProblem::average()
};

/// How a run draws that is told nothing (RunSettings), named kDefaultSetting. Where the target can be
/// averaged over irregularities, it is.
ChartSetting default_setting(const ChartTarget& target = {});

/// "quick": the default and what differs from it in one respect, one of each, all after a warm-up of 500
/// iterations; "full": all kernels with all metrics, and several of each respect. Where the default's
/// proposals are emulated, the others differ from hmc, which is a setting of its own then; where it is
/// averaged over irregularities, emulated proposals on the target itself are one as well, kHandSet.
std::vector<std::string> chart_presets();

/// @throws std::invalid_argument for a name that is not among chart_presets()
std::vector<ChartSetting> preset_settings(const std::string& preset, const ChartTarget& target);

/// Gives all settings so much warm-up; those that are then what another one before is are left out.
std::vector<ChartSetting> with_warmup(std::vector<ChartSetting> settings, int warmup);

}  // namespace patina
