#include "gui/plot/pair_grids.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace patina {
namespace {

constexpr std::uint8_t kNowhere = 255;
constexpr std::size_t kBatch = 32'768;  // draws between two looks at the clock
constexpr ImU32 kOpaque = 0xff000000u;
static_assert(PairGrids::kBins < kNowhere);

}  // namespace

void PairGrids::follow(const ExplorerModel& model, int run) {
  Contents contents{run, model.hides_warmup(), model.draws().sampling_count() > 0, model.marked(),
                    contents_.colours};
  contents.colours.follow(model, run);
  if (contents != contents_) {
    contents_ = contents;
    begin(model);
  }
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const PlotRange range = followed(axes_[i].range, model.default_range(axes_[i].axis));
    if (range == axes_[i].range) continue;
    axes_[i].range = range;
    begin_axis(i);
  }
}

void PairGrids::begin(const ExplorerModel& model) {
  axes_.clear();
  for (const PlotAxis& axis : plot_axes(model.table())) {
    const PlotRange range = padded(model.default_range(axis));
    axes_.push_back({axis, range, {}, Histogram(range, kBars)});
  }
  pairs_.assign(axes_.size() * (axes_.size() - 1) / 2, {});
  colors_.clear();
  ++edition_;
}

void PairGrids::begin_axis(std::size_t index) {
  axes_[index].bins.clear();
  axes_[index].bars = Histogram(axes_[index].range, kBars);
  for (std::size_t other = 0; other < axes_.size(); ++other) {
    if (other != index) pairs_[place_of(std::max(index, other), std::min(index, other))] = {};
  }
  ++edition_;
}

void PairGrids::bin(const ExplorerModel& model, Axis& axis, std::size_t end) const {
  const DrawColumns& draws = model.draws();
  for (std::size_t draw = axis.bins.size(); draw < end; ++draw) {
    const double place = draws.place(axis.axis, draw);
    const double bin = (place - axis.range.low) / axis.range.span() * kBins;
    const bool seen = bin >= 0 && bin < kBins && model.visible(draw);
    axis.bins.push_back(seen ? static_cast<std::uint8_t>(bin) : kNowhere);
    if (seen && model.in_answer(draw)) axis.bars.add(place, contents_.marked.contains(draw));
  }
}

void PairGrids::paint(const ExplorerModel& model, std::size_t end) {
  for (std::size_t draw = colors_.size(); draw < end; ++draw) {
    const bool dimmed = (contents_.dims_warmup && model.draws().warmup(draw)) ||
                        (!contents_.marked.empty() && !contents_.marked.contains(draw));
    colors_.push_back(dimmed ? 0 : contents_.colours.of(model, draw) | kOpaque);
  }
}

void PairGrids::count(std::size_t row, std::size_t column, std::size_t end) {
  Pair& pair = pairs_[place_of(row, column)];
  if (pair.counted == 0) pair.cells = DensityCells(kBins, kBins);
  const std::vector<std::uint8_t>&across = axes_[column].bins, &up = axes_[row].bins;
  for (std::size_t draw = pair.counted; draw < end; ++draw) {
    if (across[draw] == kNowhere || up[draw] == kNowhere) continue;
    const std::size_t cell = static_cast<std::size_t>(kBins - 1 - up[draw]) * kBins + across[draw];
    colors_[draw] != 0 ? pair.cells.add(cell, colors_[draw]) : pair.cells.add_dimmed(cell);
  }
  pair.counted = end;
}

bool PairGrids::advance(const ExplorerModel& model, const Part& part, Clock::time_point deadline) {
  assert(part.last_row <= axes_.size() && part.last_column <= axes_.size());
  const std::size_t all = model.draws().size();
  for (std::size_t row = part.first_row; row < part.last_row; ++row) {
    const std::size_t columns = std::min(part.last_column, row + 1);
    for (std::size_t column = part.first_column; column < columns; ++column) {
      // The diagonal, column == row, has its axis' bins alone.
      std::size_t done = column < row ? pair(row, column).counted : axes_[row].bins.size();
      while (done < all) {
        if (Clock::now() >= deadline) return false;
        done = std::min(all, done + kBatch);
        paint(model, done);
        bin(model, axes_[row], done);
        bin(model, axes_[column], done);
        if (column < row) count(row, column, done);
      }
    }
  }
  return true;
}

}  // namespace patina
