#include "engine/diagnostics/running_convergence.h"

#include <unsupported/Eigen/SpecialFunctions>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/diagnostics/effective_sample_size.h"

namespace patina {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr int kBins = RunningConvergence::kBins;

using Levels = Eigen::Matrix<double, kBins, 1>;
using Order = std::array<int, kBins>;
using Counts = Eigen::Matrix<float, kBins, Eigen::Dynamic>;

double variance(const Eigen::ArrayXd& x) {
  return (x - x.mean()).square().sum() / static_cast<double>(x.size() - 1);
}

/// Blom's normal scores of the levels in an order, as rank_normalise() has them for single draws.
Levels normal_scores(const Levels& pooled, const Order& order) {
  const double size = pooled.sum();
  Levels scores;
  double below = 0;
  for (const int level : order) {
    const double rank = below + 0.5 * (pooled[level] + 1);
    scores[level] = Eigen::numext::ndtri((rank - 0.375) / (size + 0.25));
    below += pooled[level];
  }
  return scores;
}

Order ascending() {
  Order order;
  std::iota(order.begin(), order.end(), 0);
  return order;
}

/// The number of levels whose draws are closest to a share of all; where a level holds so many that it is a
/// value of its own, up to the one in which the share is reached, as the draws up to a quantile are.
int levels_up_to(const Levels& pooled, double share) {
  const double wanted = share * pooled.sum(), many = 2 * pooled.sum() / kBins;
  double below = 0;
  for (int level = 0; level < kBins; ++level) {
    const double with = below + pooled[level];
    if (with >= wanted) return pooled[level] > many || with - wanted <= wanted - below ? level + 1 : level;
    below = with;
  }
  return kBins;
}

Order by_distance_from_median(const Levels& pooled, const Levels& values) {
  double below = 0;
  int middle = 0;
  while (middle + 1 < kBins && below + pooled[middle] < 0.5 * pooled.sum()) below += pooled[middle++];
  Order order = ascending();
  std::ranges::stable_sort(order, {}, [&](int level) { return std::abs(values[level] - values[middle]); });
  return order;
}

/// Stretches of chains of equal length, as histograms.
struct Halves {
  std::vector<Eigen::Map<const Counts>> batches;        ///< of each half chain
  Eigen::Matrix<double, kBins, Eigen::Dynamic> counts;  ///< a half chain in each column
  Levels pooled = Levels::Zero();
  double draws = 0;  ///< of a half chain
  double batch_length = 1;
};

struct Spread {
  Eigen::ArrayXd means, variances;  ///< of half chains, the latter divided by n
};

Spread spread(const Halves& halves, const Levels& scores) {
  const Eigen::ArrayXd means = (halves.counts.transpose() * scores).array() / halves.draws;
  const Eigen::ArrayXd squares = (halves.counts.transpose() * scores.cwiseAbs2()).array() / halves.draws;
  return {means, (squares - means.square()).max(0)};
}

/// Gelman-Rubin R-hat, as in split_rhat().
double rhat(const Halves& halves, const Levels& scores) {
  const auto [means, variances] = spread(halves, scores);
  const double within = variances.mean() * halves.draws / (halves.draws - 1);
  return std::sqrt(variance(means) / within + (halves.draws - 1) / halves.draws);
}

/// ESS of the mean of scores: their variance, between chains included, over that of the mean, which is the
/// same for batch means.
double ess(const Halves& halves, const Levels& scores, const Eigen::MatrixXd& batch_means) {
  const double size = halves.draws * static_cast<double>(halves.counts.cols());
  const Eigen::MatrixXd centred = batch_means.rowwise() - batch_means.colwise().mean();
  const double of_means = centred.squaredNorm() / static_cast<double>(batch_means.size()) +
                          variance(batch_means.colwise().mean().transpose());
  if (!(of_means > 0)) return size;
  const Spread of_draws = spread(halves, scores);
  const double total = of_draws.variances.mean() + variance(of_draws.means);
  return std::min(total / of_means * effective_sample_size(batch_means), size * std::log10(size));
}

/// The same for several kinds of scores, one in each column.
template <int kKinds>
std::array<double, kKinds> ess_of_each(const Halves& halves,
                                       const Eigen::Matrix<double, kBins, kKinds>& scores) {
  const Eigen::Matrix<float, kBins, kKinds> per_batch =
      scores.template cast<float>() / static_cast<float>(halves.batch_length);
  const Eigen::Index half = halves.batches.front().cols();
  std::array<Eigen::MatrixXd, kKinds> means;
  for (Eigen::MatrixXd& each : means) each.resize(half, halves.counts.cols());
  for (Eigen::Index k = 0; k < halves.counts.cols(); ++k) {
    const Eigen::Matrix<float, Eigen::Dynamic, kKinds> here =
        halves.batches[static_cast<std::size_t>(k)].transpose() * per_batch;
    for (int i = 0; i < kKinds; ++i)
      means[static_cast<std::size_t>(i)].col(k) = here.col(i).template cast<double>();
  }
  std::array<double, kKinds> result;
  for (std::size_t i = 0; i < kKinds; ++i)
    result[i] = ess(halves, scores.col(static_cast<Eigen::Index>(i)), means[i]);
  return result;
}

/// 1 for the lowest levels, 0 for the others: the share of draws up to a quantile.
Levels lowest(int levels) {
  Levels below = Levels::Zero();
  below.head(levels).setOnes();
  return below;
}

}  // namespace

int RunningConvergence::level_of(float value) const {
  return static_cast<int>(std::ranges::lower_bound(bounds_, value) - bounds_.begin());
}

void RunningConvergence::count(Chain& chain, std::int64_t index, float value) {
  const std::int64_t batch = index / batch_length_;
  if (batch >= chain.counts.cols()) {
    const Eigen::Index columns = chain.counts.cols();
    chain.counts.conservativeResize(Eigen::NoChange, std::max<Eigen::Index>(16, 2 * columns));
    chain.counts.rightCols(chain.counts.cols() - columns).setZero();
  }
  const int level = level_of(value);
  ++chain.counts(level, batch);
  ++pooled_[level];
}

void RunningConvergence::add(int chain, double value) {
  assert(chain >= 0);
  if (chains_.size() <= static_cast<std::size_t>(chain)) chains_.resize(static_cast<std::size_t>(chain) + 1);
  if (!std::isfinite(value)) finite_ = false;
  if (!finite_) return;
  if (total_ == 0) origin_ = value;
  Chain& own = chains_[static_cast<std::size_t>(chain)];
  own.draws.push_back(static_cast<float>(value - origin_));
  const double off = value - own.mean;
  own.mean += off / static_cast<double>(own.draws.size());
  own.squares += off * (value - own.mean);
  ++total_;

  const auto most = std::max<std::int64_t>(32, kBatches / std::ssize(chains_));
  while (own.draws_so_far() > most * batch_length_) double_batches();
  if (need_other_levels(own.draws.back()))
    revise_levels();
  else
    count(own, own.draws_so_far() - 1, own.draws.back());
}

bool RunningConvergence::need_other_levels(float value) {
  if (every_value_a_level_) {
    const auto place = std::ranges::lower_bound(distinct_, value);
    if (place != distinct_.end() && *place == value) return false;
    distinct_.insert(place, value);
    every_value_a_level_ = distinct_.size() <= kBins;
    return true;
  }
  if (total_ < look_at_) return false;
  look_at_ = total_ + total_ / 8;
  // Quantiles of half as many draws are still good levels; not so once the chains go where no level was.
  return total_ >= 2 * revised_at_ ||
         pooled_.maxCoeff() > (largest_share_ + 4.0 / kBins) * static_cast<double>(total_);
}

void RunningConvergence::double_batches() {
  batch_length_ *= 2;
  for (Chain& chain : chains_) {
    const Eigen::Index pairs = chain.counts.cols() / 2;
    for (Eigen::Index i = 0; i < pairs; ++i)
      chain.counts.col(i) = (chain.counts.col(2 * i) + chain.counts.col(2 * i + 1)).eval();
    chain.counts.rightCols(chain.counts.cols() - pairs).setZero();
  }
}

/// At most some ten thousand, evenly from all chains, ascending.
std::vector<float> RunningConvergence::some_draws() const {
  constexpr std::int64_t kMost = 1 << 15;
  const auto stride = static_cast<std::size_t>((total_ + kMost - 1) / kMost);
  std::vector<float> values;
  for (const Chain& chain : chains_)
    for (std::size_t i = 0; i < chain.draws.size(); i += stride) values.push_back(chain.draws[i]);
  std::ranges::sort(values);
  return values;
}

void RunningConvergence::revise_levels() {
  const std::vector<float> sample = every_value_a_level_ ? distinct_ : some_draws();
  bounds_.clear();
  if (every_value_a_level_) bounds_.assign(distinct_.begin(), distinct_.end() - 1);
  for (int i = 1; i < kBins && !every_value_a_level_; ++i) {
    const float bound = sample[sample.size() * static_cast<std::size_t>(i) / kBins];
    if (bounds_.empty() || bounds_.back() != bound) bounds_.push_back(bound);
  }

  Levels sums = Levels::Zero(), numbers = Levels::Zero();
  for (const float value : sample) sums[level_of(value)] += value, ++numbers[level_of(value)];
  for (int level = 0; level < kBins; ++level)
    values_[level] = numbers[level] > 0 ? sums[level] / numbers[level] : sample.back();

  pooled_.setZero();
  for (Chain& chain : chains_) {
    chain.counts.setZero();
    std::int64_t index = 0;
    for (const float value : chain.draws) count(chain, index++, value);
  }
  revised_at_ = total_;
  largest_share_ = pooled_.maxCoeff() / static_cast<double>(total_);
}

void RunningConvergence::moments(ConvergenceFigures& figures) const {
  double sum = 0, squares = 0;
  for (const Chain& chain : chains_) sum += chain.mean * static_cast<double>(chain.draws.size());
  figures.mean = sum / static_cast<double>(total_);
  for (const Chain& chain : chains_) {
    squares +=
        chain.squares + std::pow(chain.mean - figures.mean, 2) * static_cast<double>(chain.draws.size());
    figures.chain_means.push_back(chain.draws.empty() ? kNaN : chain.mean);
  }
  figures.sd = std::sqrt(squares / static_cast<double>(total_ - 1));
}

ConvergenceFigures RunningConvergence::figures() const {
  ConvergenceFigures figures{kNaN, kNaN, kNaN, kNaN, kNaN, kNaN, {}};
  if (!finite_ || total_ < 2) return figures;
  moments(figures);

  std::int64_t batches = std::numeric_limits<std::int64_t>::max();
  std::vector<const Chain*> chains;
  for (const Chain& chain : chains_) {
    if (chain.draws.empty()) continue;
    chains.push_back(&chain);
    batches = std::min(batches, batches_of(chain));
  }
  const Eigen::Index half = batches / 2, halves_count = 2 * std::ssize(chains);
  if (half < 2) return figures;
  Halves halves;
  halves.batch_length = static_cast<double>(batch_length_);
  halves.draws = static_cast<double>(half) * halves.batch_length;
  halves.counts.resize(Eigen::NoChange, halves_count);
  for (const bool later : {false, true})
    for (const Chain* chain : chains) {
      const std::int64_t first = later ? batches - half : 0;
      halves.batches.emplace_back(chain->counts.col(first).data(), kBins, half);
      halves.counts.col(std::ssize(halves.batches) - 1) =
          halves.batches.back().rowwise().sum().cast<double>();
    }
  halves.pooled = halves.counts.rowwise().sum();

  const double size = halves.pooled.sum();
  if (halves.pooled.maxCoeff() == size) {  // constant
    figures.bulk_ess = figures.tail_ess = figures.mean_ess = size;
    return figures;
  }
  const Levels scores = normal_scores(halves.pooled, ascending());
  const Levels folded = normal_scores(halves.pooled, by_distance_from_median(halves.pooled, values_));
  figures.rhat = std::fmax(rhat(halves, scores), rhat(halves, folded));
  Eigen::Matrix<double, kBins, 4> kinds;
  kinds << scores, values_, lowest(levels_up_to(halves.pooled, 0.05)),
      lowest(levels_up_to(halves.pooled, 0.95));
  const auto [bulk, mean, low, high] = ess_of_each(halves, kinds);
  figures.bulk_ess = bulk;
  figures.mean_ess = mean;
  figures.tail_ess = std::min(low, high);
  return figures;
}

std::size_t RunningConvergence::bytes() const {
  std::size_t bytes = bounds_.capacity() * sizeof(float) + chains_.capacity() * sizeof(Chain);
  for (const Chain& chain : chains_)
    bytes +=
        chain.draws.size() * sizeof(float) + static_cast<std::size_t>(chain.counts.size()) * sizeof(float);
  return bytes;
}

}  // namespace patina
