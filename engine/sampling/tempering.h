#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/sampling/archive.h"
#include "engine/sampling/kernel.h"

namespace patina {

// Non-reversible parallel tempering (Syed, Bouchard-Cote, Deligiannidis, Doucet 2022, "Non-reversible
// parallel tempering: a scalable highly parallel MCMC scheme", JRSSB 84:321) between prior and posterior, for
// targets in coordinates in which the prior is N(0, I) and all levels are equally likely: what is left of the
// log density, log density + |x|^2 / 2, is the log likelihood, and no rung needs evaluations of its own kind.

/// The log likelihood of a place, constants dropped. -infinity outside the support.
double log_likelihood(const ChainState& state);

/// Prior times likelihood^beta: beta log pi(x) - (1 - beta) |x|^2 / 2. The target must outlive it.
class TemperedDensity final : public LogDensity {
 public:
  /// @param beta  inverse temperature: in (0, 1], 1 the target itself
  TemperedDensity(const LogDensity& target, double beta);

  Eigen::Index dimension() const override { return target_.dimension(); }
  std::vector<int> discrete_levels() const override { return target_.discrete_levels(); }
  std::vector<bool> jagged() const override { return jagged_; }
  Evaluation evaluate(const Position& position) const override;
  Evaluation value(const Position& position) const override;

  /// A state of the target as one of this density, and back, without an evaluation. At beta = 1 both are
  /// exact.
  ChainState tempered(const ChainState& state) const;
  ChainState untempered(const ChainState& state) const;

 private:
  double tempered_value(const Position& position, double of_target) const;
  Eigen::VectorXd prior_pull(const Position& position) const;

  const LogDensity& target_;
  double beta_;
  std::vector<bool> jagged_;
};

/// The metric of the tempered density, as far as that is normal, from the target's: precisions of prior and
/// likelihood add up. At beta = 1 it is the target's.
std::shared_ptr<const Metric> tempered_metric(const std::shared_ptr<const Metric>& of_target, double beta);

/// Inverse temperatures from 0, the prior, to 1, the target. @param rungs  at least 2
std::vector<double> first_ladder(int rungs);

/// The ladder of as many rungs on which neighbours would reject their swaps equally often: what rejections
/// add up to from the prior on (the communication barrier), taken as linear between rungs, is cut into equal
/// parts (algorithm 2 there). A ladder of one or two rungs stays as it is.
/// @param rejection  mean probability that the swap of rungs i and i + 1 is rejected
std::vector<double> equalised_ladder(const std::vector<double>& betas, const std::vector<double>& rejection);

/// States that travel a ladder. Rung 0 holds draws of the prior, the last one the target's chain, which may
/// also be the only one.
struct TemperedState {
  std::vector<ChainState> rungs;  ///< evaluations are of the target itself
  std::vector<int> traveller;     ///< who is on each rung
  std::vector<char> from_prior;   ///< of each traveller: was at the prior more recently than at the target
  std::int64_t rounds = 0;
  std::int64_t round_trips = 0;  ///< arrivals at the target from the prior
};

/// All rungs there, each a traveller of its own. @param rungs  states of the target, the prior's first
TemperedState tempered_state(std::vector<ChainState> rungs);

/// How often swaps were rejected.
class SwapRecord {
 public:
  SwapRecord() = default;  ///< of a single rung
  explicit SwapRecord(std::size_t rungs) : rejected_(rungs - 1, 0.0), tried_(rungs - 1, 0) {}

  void add(std::size_t lower_rung, double accept_probability);
  void add(const SwapRecord& other);
  std::vector<double> rejection() const;  ///< mean of each pair; 0 where none was tried

  std::size_t rungs() const { return tried_.size() + 1; }

  /// All fields; see Archive. @throws ArchiveError for what no record can hold
  void serialise(Archive& archive);

 private:
  std::vector<double> rejected_;
  std::vector<std::int64_t> tried_;
};

/// Proposes to swap the states of neighbouring rungs: of even and odd pairs in turn, which is what makes
/// travellers keep their direction and a round trip take time linear in the rungs. Leaves the product of all
/// tempered densities invariant. No evaluations.
void swap_rungs(const std::vector<double>& betas, TemperedState& state, SwapRecord& record, Rng& rng);

/// Round trips a round, if every rung forgot where it was between two swaps (Syed et al., corollary 2): the
/// most that a ladder of these rejections can do.
double ideal_round_trip_rate(const std::vector<double>& rejection);

}  // namespace patina
