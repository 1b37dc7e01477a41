#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <deque>
#include <vector>

namespace patina {

/// What RunningConvergence knows of one quantity; names as in convergence.h.
struct ConvergenceFigures {
  double mean = 0, sd = 0;
  double rhat = 0, bulk_ess = 0, tail_ess = 0, mean_ess = 0;
  std::vector<double> chain_means;  ///< NaN for a chain without draws
};

/// Split R-hat, ESS and moments of one quantity of chains that grow: what a draw adds, and what a question
/// costs, do not grow with the draws that are there. Two approximations make that so:
///  * Draws are rounded to kBins levels between their quantiles, so that a stretch of chain is a histogram
///  and the
///    ranks, scores and quantiles of all draws are sums over levels. Moments are exact.
///  * The variance of a mean comes from batches (Geyer 1992, section 3.2): batch means are a chain, too,
///  whose
///    initial monotone sequence (see effective_sample_size()) is summed in place of the draws'. Up to
///    kBatches draws in all a batch is one draw; beyond, batches grow by doubling, so that there are kBatches
///    / 2 to kBatches of them.
/// Against the functions of convergence.h over the same draws: R-hat - 1 to 3 % of itself and 0.002, ESS to
/// 20 % (batch means scatter; tests/diagnostics/running_convergence_test.cpp). At most one batch of each
/// chain's newest draws is left out of R-hat and ESS. Quantities of at most kBins distinct values are not
/// rounded.
class RunningConvergence {
 public:
  static constexpr int kBins = 128;
  static constexpr int kBatches = 2048;  ///< over all chains

  /// The next draw of a chain. Chains may be of different length: R-hat and ESS are of what all of them have.
  void add(int chain, double value);

  std::int64_t draws() const { return total_; }

  /// NaN where undefined, as in convergence.h.
  ConvergenceFigures figures() const;

  /// Bytes of the heap that it holds.
  std::size_t bytes() const;

 private:
  using Counts = Eigen::Matrix<float, kBins, Eigen::Dynamic>;
  using Levels = Eigen::Matrix<double, kBins, 1>;

  struct Chain {
    std::deque<float> draws;       ///< less origin_; for when the levels must change
    Counts counts;                 ///< how many draws of each level, a column per batch
    double mean = 0, squares = 0;  ///< Welford 1962: of the draws, and of their deviations
    std::int64_t draws_so_far() const { return static_cast<std::int64_t>(draws.size()); }
  };

  std::int64_t batches_of(const Chain& chain) const { return chain.draws_so_far() / batch_length_; }
  int level_of(float value) const;
  void count(Chain& chain, std::int64_t index, float value);
  void double_batches();
  bool need_other_levels(float value);
  void revise_levels();
  std::vector<float> some_draws() const;
  void moments(ConvergenceFigures& figures) const;

  std::vector<Chain> chains_;
  double origin_ = 0;
  bool finite_ = true;
  std::int64_t total_ = 0, revised_at_ = 0, look_at_ = 0, batch_length_ = 1;
  bool every_value_a_level_ = true;  ///< as long as there are few
  std::vector<float> distinct_;      ///< those values, ascending
  std::vector<float> bounds_;        ///< upper ones of all levels but the last, ascending
  Levels values_ = Levels::Zero();   ///< what a draw of each level is taken for, less origin_
  Levels pooled_ = Levels::Zero();   ///< draws of each level
  double largest_share_ = 0;         ///< of a level, when they were revised
};

}  // namespace patina
