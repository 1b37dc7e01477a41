#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "gui/plot/density_grid.h"
#include "gui/plot/draw_colours.h"
#include "gui/plot/histogram.h"

namespace patina {

/// How the draws lie over every pair of axes, and along every axis alone: counted a little at a time, so that
/// any number of axes and draws leaves frames short. No ImGui, no GL.
class PairGrids {
 public:
  static constexpr int kBins = 64;  ///< along an axis
  static constexpr int kBars = 32;  ///< of an axis alone

  /// The pairs that are looked at: rows of [first_row, last_row), columns likewise.
  struct Part {
    std::size_t first_row = 0, last_row = 0, first_column = 0, last_column = 0;
  };
  using Clock = std::chrono::steady_clock;

  /// Takes up what is shown. Where it changed, all or the axes concerned are counted anew.
  /// @param run  tells one run's draws from another's
  void follow(const ExplorerModel& model, int run);

  /// Counts draws into the pairs of a part until the deadline at most. @return whether all are counted
  bool advance(const ExplorerModel& model, const Part& part, Clock::time_point deadline);

  std::size_t size() const { return axes_.size(); }  ///< axes: parameters, discrete ones, the match
  const PlotAxis& axis(std::size_t index) const { return axes_[index].axis; }
  const PlotRange& range(std::size_t index) const { return axes_[index].range; }
  const Histogram& bars(std::size_t index) const { return axes_[index].bars; }  ///< of the answer's draws
  const DrawColours& colours() const { return contents_.colours; }

  /// The draws over a pair of axes. @param column  less than `row`
  const DensityCells& cells(std::size_t row, std::size_t column) const { return pair(row, column).cells; }
  /// Draws counted into it since it was begun; 0 again where it was begun anew.
  std::size_t counted(std::size_t row, std::size_t column) const { return pair(row, column).counted; }
  /// Grows whenever pairs are begun anew.
  int edition() const { return edition_; }

 private:
  struct Axis {
    PlotAxis axis;
    PlotRange range;
    std::vector<std::uint8_t> bins;  ///< of the draws; kNowhere of those that are not seen
    Histogram bars;
  };
  struct Pair {
    DensityCells cells;
    std::size_t counted = 0;
  };
  /// What the counts were made from; anything else there means to begin again.
  struct Contents {
    int run = -1;
    bool hides_warmup = false, dims_warmup = false;
    DrawSet marked;
    DrawColours colours;
    bool operator==(const Contents&) const = default;
  };

  static std::size_t place_of(std::size_t row, std::size_t column) { return row * (row - 1) / 2 + column; }
  const Pair& pair(std::size_t row, std::size_t column) const { return pairs_[place_of(row, column)]; }
  void begin(const ExplorerModel& model);
  void begin_axis(std::size_t index);
  void bin(const ExplorerModel& model, Axis& axis, std::size_t end) const;
  void paint(const ExplorerModel& model, std::size_t end);
  void count(std::size_t row, std::size_t column, std::size_t end);

  Contents contents_;
  std::vector<Axis> axes_;
  std::vector<Pair> pairs_;            ///< the lower triangle, row by row
  std::vector<std::uint32_t> colors_;  ///< of the draws, opaque; 0 of those that are dimmed
  int edition_ = 0;
};

}  // namespace patina
