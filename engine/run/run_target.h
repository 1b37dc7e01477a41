#pragma once

#include <memory>
#include <vector>

#include "engine/posterior/posterior.h"
#include "engine/posterior/vetted_density.h"
#include "engine/run/controlled_density.h"
#include "engine/run/mode_search.h"
#include "engine/run/run_control.h"
#include "engine/run/run_settings.h"
#include "engine/sampling/kernel.h"

namespace patina {

/// What the chains of a run draw from, and the kernels that do: the posterior, or its average over
/// irregularities where one was learnt.
class RunTarget {
 public:
  /// All that is given outlives this.
  /// @param found  under the posterior's errors
  RunTarget(const Posterior& posterior, const ModeFound& found, const RunSettings& settings,
            RunControl& control);
  RunTarget(const RunTarget&) = delete;  // the density refers to the average
  RunTarget& operator=(const RunTarget&) = delete;

  const LogDensity& density() const { return density_; }  ///< controlled
  /// By what was found until now: what an emulator has learnt since the last one counts.
  std::unique_ptr<Kernel> kernel() const;
  /// Where chains begin, about, and how far that spreads.
  ChainState mode() const;
  std::shared_ptr<const Metric> spread() const;

 private:
  const Posterior& posterior_;
  const ModeFound& found_;
  const RunSettings& settings_;
  std::unique_ptr<const VettedDensity> average_;  ///< none: the posterior is drawn from
  ControlledDensity density_;
};

}  // namespace patina
