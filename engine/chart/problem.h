#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/chart/setting.h"
#include "engine/posterior/emulate.h"
#include "engine/sampling/chain_state.h"
#include "engine/sampling/kernel.h"
#include "engine/sampling/log_density.h"
#include "engine/sampling/metric.h"

namespace patina {

/// What a chart is made of: a posterior that settings can be tried on. Safe to use from several threads.
class ChartProblem {
 public:
  virtual ~ChartProblem() = default;

  /// One line that says which target it is; without line break.
  virtual std::string description() const = 0;

  /// Of the quantities that draws are compared in: continuous ones as values() has them, then discrete ones.
  virtual std::vector<std::string> names() const = 0;

  /// The target as a setting has it, from coarse to fine: the search begins with the first, the last is drawn
  /// from. All of one space, that of every other setting as well.
  virtual std::vector<std::unique_ptr<LogDensity>> targets(const ChartSetting& setting) const = 0;

  /// A target that simulations make, where a setting asks for it; its mode and the covariance there.
  struct Learnt {
    std::unique_ptr<LogDensity> target;
    ChainState mode;
    std::shared_ptr<const Metric> laplace;
  };
  /// @param simulated  called after each of the simulations, from any thread; what it throws ends them
  virtual Learnt learn(const ChartSetting& setting, std::uint64_t seed,
                       const std::function<void()>& simulated) const;

  /// The target averaged over irregularities, where a setting asks for it, and what draws from it.
  struct Averaged {
    Learnt learnt;
    std::unique_ptr<Kernel> kernel;
  };
  /// @param ends       that a search of the target ended in, best first
  /// @param evaluated  called after each evaluation, from any thread; what it throws ends them
  /// @return           none where nothing follows the target's averages
  virtual std::optional<Averaged> average(const ChartSetting& setting, const std::vector<ChainState>& ends,
                                          std::uint64_t seed, const std::function<void()>& evaluated) const;

  /// An emulator of the target's informed coordinates, where a setting's kernel proposes by one: emulate().
  /// @param evaluated  called after each evaluation, from any thread; what it throws ends them
  virtual Emulation emulate(const ChartSetting& setting, const std::vector<ChainState>& starts,
                            const Metric& laplace, std::uint64_t seed,
                            const std::function<void()>& evaluated) const;
  /// And another one of places that chains have come to: emulate_about().
  /// @param places  of all coordinates, a column each
  virtual Emulator emulate_about(const ChartSetting& setting, const Eigen::MatrixXd& places,
                                 const KnownResiduals& known, const ChainState& mode, const Metric& laplace,
                                 std::uint64_t seed, const std::function<void()>& evaluated) const;
  virtual std::vector<Eigen::Index> informed() const { return {}; }

  /// The continuous quantities at a position, in their own units.
  virtual Eigen::VectorXd values(const Position& position) const = 0;

  /// make_kernel() as the setting says.
  virtual std::unique_ptr<Kernel> kernel(const ChartSetting& setting, const LogDensity& target) const;

  /// How many threads an evaluation that is called from this thread may use.
  virtual void use_threads(int) const {}
};

/// The target itself: as a setting has it that says nothing of resolution and summary.
std::unique_ptr<LogDensity> target_of(const ChartProblem& problem);

/// Log densities at a few places: what tells a target from another one, also where only a network's weights
/// or the program differ.
std::vector<double> fingerprint(const LogDensity& target);

/// Whether two fingerprints are one target's, up to the rounding of renders.
bool same_target(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace patina
