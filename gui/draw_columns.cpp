#include "gui/draw_columns.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace patina {
namespace {

constexpr double kSpread = 0.3;

/// Evenly scattered over [-1, 1] by the golden ratio; the same for a draw at every frame.
double scatter(std::size_t draw) {
  const double turns = 0.61803398874989485 * static_cast<double>(draw + 1);
  return 2 * (turns - std::floor(turns)) - 1;
}

}  // namespace

DrawColumns::Extent::Extent()
    : low(std::numeric_limits<double>::infinity()), high(-std::numeric_limits<double>::infinity()) {}

void DrawColumns::Extent::include(double value) {
  if (!std::isfinite(value)) return;
  low = std::min(low, value);
  high = std::max(high, value);
}

DrawColumns::DrawColumns(const ParameterTable& table)
    : continuous_(table.continuous.size()),
      discrete_(table.discrete.size()),
      extent_of_all_(continuous_.size() + discrete_.size() + 2),
      extent_of_sampling_(extent_of_all_.size()) {}

void DrawColumns::append(std::span<const Draw> draws) {
  for (const Draw& draw : draws) {
    if (draw.values.continuous.size() == continuous_.size() &&
        draw.values.discrete.size() == discrete_.size())
      append(draw);
  }
}

void DrawColumns::append(const Draw& draw) {
  for (std::size_t i = 0; i < continuous_.size(); ++i) continuous_[i].push_back(draw.values.continuous[i]);
  for (std::size_t i = 0; i < discrete_.size(); ++i) discrete_[i].push_back(draw.values.discrete[i]);
  lp_.push_back(draw.lp);
  chain_.push_back(draw.chain);
  iteration_.push_back(draw.iteration);
  flags_.push_back(
      static_cast<std::uint8_t>((draw.warmup ? kWarmup : 0) | (draw.divergent ? kDivergent : 0)));
  chain_count_ = std::max(chain_count_, draw.chain + 1);
  sampling_count_ += draw.warmup ? 0 : 1;
  if (draw.warmup) warmup_steps_ = std::max(warmup_steps_, draw.iteration + 1);
  const auto improve = [&](std::optional<std::size_t>& best) {
    if (!std::isnan(draw.lp) && (!best || draw.lp > lp_[*best])) best = size() - 1;
  };
  improve(best_of_all_);
  if (!draw.warmup) improve(best_of_sampling_);

  const auto include = [&](std::size_t column, double value) {
    extent_of_all_[column].include(value);
    if (!draw.warmup) extent_of_sampling_[column].include(value);
  };
  for (std::size_t i = 0; i < continuous_.size(); ++i) include(i, draw.values.continuous[i]);
  for (std::size_t i = 0; i < discrete_.size(); ++i) {
    include(continuous_.size() + i, draw.values.discrete[i] - 0.5);
    include(continuous_.size() + i, draw.values.discrete[i] + 0.5);
  }
  include(extent_of_all_.size() - 2, draw.lp);
  include(extent_of_all_.size() - 1, static_cast<double>(draw.iteration));
}

ParameterValues DrawColumns::values(std::size_t draw) const {
  ParameterValues values;
  for (const auto& column : continuous_) values.continuous.push_back(column[draw]);
  for (const auto& column : discrete_) values.discrete.push_back(column[draw]);
  return values;
}

std::optional<std::size_t> DrawColumns::find(const DrawPlace& place, std::size_t first) const {
  for (std::size_t draw = first; draw < size(); ++draw)
    if (iteration_[draw] == place.iteration && chain_[draw] == place.chain) return draw;
  return std::nullopt;
}

double DrawColumns::place(const PlotAxis& axis, std::size_t draw) const {
  switch (axis.kind) {
    case PlotAxis::Kind::continuous:
      return continuous_[axis.index][draw];
    case PlotAxis::Kind::discrete:
      return discrete_[axis.index][draw] + kSpread * scatter(draw);
    case PlotAxis::Kind::log_posterior:
      return lp_[draw];
    case PlotAxis::Kind::iteration:
      return static_cast<double>(iteration_[draw]);
  }
  return 0;
}

void DrawColumns::places(const PlotAxis& axis, std::size_t first, std::span<double> places) const {
  const bool as_kept = axis.kind == PlotAxis::Kind::continuous || axis.kind == PlotAxis::Kind::log_posterior;
  const ChunkedColumn<double>& column =
      axis.kind == PlotAxis::Kind::continuous ? continuous_[axis.index] : lp_;
  for (std::size_t i = 0; i < places.size();) {
    if (as_kept) {
      const auto run = column.run(first + i);
      const std::size_t count = std::min(run.size(), places.size() - i);
      std::copy_n(run.begin(), count, places.begin() + static_cast<std::ptrdiff_t>(i));
      i += count;
    } else {
      places[i] = place(axis, first + i);
      ++i;
    }
  }
}

std::size_t DrawColumns::column_of(const PlotAxis& axis) const {
  switch (axis.kind) {
    case PlotAxis::Kind::continuous:
      return axis.index;
    case PlotAxis::Kind::discrete:
      return continuous_.size() + axis.index;
    case PlotAxis::Kind::log_posterior:
      return continuous_.size() + discrete_.size();
    case PlotAxis::Kind::iteration:
      return continuous_.size() + discrete_.size() + 1;
  }
  return 0;
}

PlotRange DrawColumns::extent(const PlotAxis& axis, bool after_warmup) const {
  const Extent& extent = (after_warmup ? extent_of_sampling_ : extent_of_all_)[column_of(axis)];
  return extent.low <= extent.high ? PlotRange{extent.low, extent.high} : PlotRange{};
}

}  // namespace patina
