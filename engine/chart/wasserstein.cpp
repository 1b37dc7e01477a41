#include "engine/chart/wasserstein.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

namespace patina {
namespace {

/// In draws. Five autocorrelation times leave a tenth of the variance between blocks out; fewer than twenty
/// blocks would leave too few to resample.
Eigen::Index block_length(const Eigen::MatrixXd& draws, double ess) {
  constexpr double kAutocorrelationTimes = 5, kFewestBlocks = 20;
  const auto size = static_cast<double>(draws.size());
  const double time = ess > 0 ? std::max(size / ess, 1.0) : size;
  const double longest = std::min(size / kFewestBlocks, static_cast<double>(draws.rows()));
  return std::max<Eigen::Index>(std::llround(std::min(kAutocorrelationTimes * time, longest)), 1);
}

}  // namespace

BlockedSample::BlockedSample(const Eigen::MatrixXd& draws, double ess) {
  assert(draws.size() > 0);
  const Eigen::Index blocks_a_chain = std::max<Eigen::Index>(draws.rows() / block_length(draws, ess), 1);
  block_size_.resize(static_cast<std::size_t>(blocks_a_chain * draws.cols()));
  std::vector<std::pair<double, int>> entries;
  for (Eigen::Index k = 0; k < draws.cols(); ++k)
    for (Eigen::Index i = 0; i < draws.rows(); ++i) {
      const auto block = static_cast<int>(k * blocks_a_chain + i * blocks_a_chain / draws.rows());
      entries.emplace_back(draws(i, k), block);
      ++block_size_[static_cast<std::size_t>(block)];
    }
  std::ranges::sort(entries);
  for (const auto& [value, block] : entries) {
    values_.push_back(value);
    block_.push_back(block);
  }
}

double BlockedSample::distance_to_law(Rng& rng, int resamples) const {
  const auto blocks = static_cast<int>(block_size_.size());
  double sum_of_squares = 0;
  for (int resample = 0; resample < resamples; ++resample) {
    std::vector<int> times(block_size_.size());
    for (int i = 0; i < blocks; ++i) ++times[static_cast<std::size_t>(rng.below(blocks))];
    const double total = std::inner_product(times.begin(), times.end(), block_size_.begin(), 0.0);
    const double each = 1.0 / static_cast<double>(values_.size());
    double difference = 0, area = 0;
    for (std::size_t i = 0; i + 1 < values_.size(); ++i) {
      difference += times[static_cast<std::size_t>(block_[i])] / total - each;
      area += std::abs(difference) * (values_[i + 1] - values_[i]);
    }
    sum_of_squares += area * area;
  }
  return std::sqrt(sum_of_squares / resamples);
}

double wasserstein_1(const std::vector<double>& a, const std::vector<double>& b) {
  assert(!a.empty() && !b.empty());
  const double share_a = 1.0 / static_cast<double>(a.size()), share_b = 1.0 / static_cast<double>(b.size());
  std::size_t i = 0, j = 0;
  double area = 0, here = std::min(a.front(), b.front());
  while (i < a.size() || j < b.size()) {
    const bool from_a = j == b.size() || (i < a.size() && a[i] <= b[j]);
    const double next = from_a ? a[i] : b[j];
    area += std::abs(static_cast<double>(i) * share_a - static_cast<double>(j) * share_b) * (next - here);
    here = next;
    ++(from_a ? i : j);
  }
  return area;
}

}  // namespace patina
