#include "resources/networks/gram_distance.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/linalg_vector_norm.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace patina {
namespace {

double length(const at::Tensor& x) { return at::linalg_vector_norm(x).item<double>(); }

/// Ranks less their mean.
std::vector<double> centred_ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
  std::vector<double> ranks(values.size());
  for (std::size_t begin = 0, end; begin < order.size(); begin = end) {
    for (end = begin + 1; end < order.size() && values[order[end]] == values[order[begin]];) ++end;
    const double rank = static_cast<double>(begin + end) / 2 - static_cast<double>(order.size()) / 2;
    for (std::size_t i = begin; i < end; ++i) ranks[order[i]] = rank;
  }
  return ranks;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

double gram_distance(const at::Tensor& a, const at::Tensor& b, const std::vector<SummaryBlock>& blocks) {
  double sum = 0;
  std::int64_t begin = 0, count = 0;
  for (const SummaryBlock& block : blocks) {
    const at::Tensor block_a = a.narrow(0, begin, block.size), block_b = b.narrow(0, begin, block.size);
    begin += block.size;
    if (block.scale != ErrorScale::relative) continue;
    sum += length(block_a - block_b) / (length(block_a) / 2 + length(block_b) / 2);
    ++count;
  }
  return sum / static_cast<double>(count);
}

double spearman(const std::vector<double>& a, const std::vector<double>& b) {
  assert(a.size() == b.size());
  const std::vector<double> ranks_a = centred_ranks(a), ranks_b = centred_ranks(b);
  return dot(ranks_a, ranks_b) / std::sqrt(dot(ranks_a, ranks_a) * dot(ranks_b, ranks_b));
}

}  // namespace patina
