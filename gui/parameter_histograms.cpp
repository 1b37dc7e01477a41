#include "gui/parameter_histograms.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace patina {

ParameterHistograms::ParameterHistograms(const ParameterTable& table, std::vector<PlotRange> ranges)
    : ranges_(std::move(ranges)), bins_(table.continuous.size(), std::vector<std::uint32_t>(kBins)) {
  assert(ranges_.size() == bins_.size());
  for (const DiscreteParameter& parameter : table.discrete) levels_.emplace_back(parameter.levels.size());
}

bool ParameterHistograms::follow(const DrawColumns& draws, std::size_t most) {
  const std::size_t end = std::min(draws.size(), seen_ + most);
  for (; seen_ < end; ++seen_)
    if (!draws.warmup(seen_)) add(draws, seen_);
  return seen_ == draws.size();
}

void ParameterHistograms::add(const DrawColumns& draws, std::size_t draw) {
  ++total_;
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    const double value = draws.place({PlotAxis::Kind::continuous, i}, draw);
    const double share = (value - ranges_[i].low) / ranges_[i].span();
    if (!std::isfinite(share)) continue;
    ++bins_[i][static_cast<std::size_t>(std::clamp(share * kBins, 0.0, kBins - 1.0))];
  }
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    // A level's place is scattered by less than a half about its index.
    const long level = std::lround(draws.place({PlotAxis::Kind::discrete, i}, draw));
    if (level >= 0 && level < static_cast<long>(levels_[i].size()))
      ++levels_[i][static_cast<std::size_t>(level)];
  }
}

}  // namespace patina
