#include "gui/plot/parameter_histograms.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace patina {

ParameterHistograms::ParameterHistograms(const ParameterTable& table, const std::vector<PlotRange>& ranges) {
  assert(ranges.size() == table.continuous.size());
  for (const PlotRange& range : ranges) continuous_.emplace_back(range, kBins);
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
  for (std::size_t i = 0; i < continuous_.size(); ++i) {
    const auto& [low, high] = continuous_[i].range();
    const double value = draws.place({PlotAxis::Kind::continuous, i}, draw);
    if (std::isfinite(value)) continuous_[i].add(std::clamp(value, low, std::nextafter(high, low)), false);
  }
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    // A level's place is scattered by less than a half about its index.
    const long level = std::lround(draws.place({PlotAxis::Kind::discrete, i}, draw));
    if (level >= 0 && level < static_cast<long>(levels_[i].size()))
      ++levels_[i][static_cast<std::size_t>(level)];
  }
}

}  // namespace patina
