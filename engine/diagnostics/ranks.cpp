#include "engine/diagnostics/ranks.h"

#include <unsupported/Eigen/SpecialFunctions>

#include <algorithm>
#include <cmath>
#include <utility>

namespace patina {

Eigen::MatrixXd split_chains(const Eigen::Ref<const Eigen::MatrixXd>& draws) {
  const Eigen::Index half = draws.rows() / 2, chains = draws.cols();
  Eigen::MatrixXd split(half, 2 * chains);
  split.leftCols(chains) = draws.topRows(half);
  split.rightCols(chains) = draws.bottomRows(half);
  return split;
}

Eigen::MatrixXd rank_normalise(const Eigen::MatrixXd& draws) {
  const Eigen::Index size = draws.size();
  std::vector<std::pair<double, Eigen::Index>> order(size);
  for (Eigen::Index i = 0; i < size; ++i) order[i] = {draws.data()[i], i};
  std::sort(order.begin(), order.end());

  Eigen::MatrixXd scores(draws.rows(), draws.cols());
  for (Eigen::Index begin = 0, end; begin < size; begin = end) {
    for (end = begin + 1; end < size && order[end].first == order[begin].first;) ++end;
    const double rank = 0.5 * static_cast<double>(begin + 1 + end);  // the average of begin+1 ... end
    const double score = Eigen::numext::ndtri((rank - 0.375) / (static_cast<double>(size) + 0.25));
    for (Eigen::Index i = begin; i < end; ++i) scores.data()[order[i].second] = score;
  }
  return scores;
}

std::vector<double> pooled_values(const Eigen::Ref<const Eigen::MatrixXd>& draws) {
  std::vector<double> values;
  values.reserve(draws.size());
  for (const auto chain : draws.colwise()) values.insert(values.end(), chain.begin(), chain.end());
  return values;
}

double order_statistic(std::vector<double>& values, std::size_t index) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(index);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

double quantile_of(std::vector<double>& values, double probability) {
  const double place = probability * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(std::floor(place));
  const double low = order_statistic(values, below);
  const double high = order_statistic(values, std::min(below + 1, values.size() - 1));
  return low + (place - std::floor(place)) * (high - low);
}

}  // namespace patina
