#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/run/draw.h"
#include "gui/chunked_column.h"
#include "gui/draw_place.h"
#include "gui/plot/plot_axis.h"

namespace patina {

/// All draws of a run as columns, in order of arrival. A draw's index never changes. A draw takes 21
/// bytes more than its values: a million of a dozen parameters about 120 MB.
class DrawColumns {
 public:
  explicit DrawColumns(const ParameterTable& table = {});

  /// Draws whose number of values is not the table's are left out.
  void append(std::span<const Draw> draws);

  std::size_t size() const { return lp_.size(); }
  std::size_t sampling_count() const { return sampling_count_; }  ///< draws after warm-up
  int chain_count() const { return chain_count_; }
  /// Steps of warm-up, as far as draws tell: one more than the last iteration of a draw of warm-up.
  std::int64_t warmup_steps() const { return warmup_steps_; }

  double lp(std::size_t draw) const { return lp_[draw]; }
  int chain(std::size_t draw) const { return chain_[draw]; }
  std::int64_t iteration(std::size_t draw) const { return iteration_[draw]; }
  bool warmup(std::size_t draw) const { return (flags_[draw] & kWarmup) != 0; }
  bool divergent(std::size_t draw) const { return (flags_[draw] & kDivergent) != 0; }
  ParameterValues values(std::size_t draw) const;

  /// The first of those with the highest lp, of the draws after warm-up or of all.
  std::optional<std::size_t> best(bool after_warmup) const {
    return after_warmup ? best_of_sampling_ : best_of_all_;
  }

  DrawPlace where(std::size_t draw) const { return {chain(draw), iteration(draw)}; }
  /// The draw at a place of a chain, if it is there. Looks at all from `first` on.
  std::optional<std::size_t> find(const DrawPlace& place, std::size_t first = 0) const;

  /// Where the draw lies along an axis. Levels of a discrete parameter are spread over +-0.3, each draw by an
  /// amount of its own, so that a cloud can be seen and clicked.
  double place(const PlotAxis& axis, std::size_t draw) const;

  /// place() of the draws from `first` on, as many as fit; faster for many.
  void places(const PlotAxis& axis, std::size_t first, std::span<double> places) const;

  /// From the lowest to the highest finite place of the draws after warm-up, or of all draws; nothing yet:
  /// [0, 1].
  PlotRange extent(const PlotAxis& axis, bool after_warmup) const;

 private:
  static constexpr std::uint8_t kWarmup = 1, kDivergent = 2;

  struct Extent {
    double low, high;
    Extent();
    void include(double value);
  };
  std::size_t column_of(const PlotAxis& axis) const;
  void append(const Draw& draw);

  std::vector<ChunkedColumn<double>> continuous_;
  std::vector<ChunkedColumn<std::int32_t>> discrete_;
  ChunkedColumn<double> lp_;
  ChunkedColumn<std::int32_t> chain_;
  ChunkedColumn<std::int64_t> iteration_;
  ChunkedColumn<std::uint8_t> flags_;
  std::vector<Extent> extent_of_all_, extent_of_sampling_;  ///< continuous, discrete, lp, iteration
  std::optional<std::size_t> best_of_all_, best_of_sampling_;
  std::size_t sampling_count_ = 0;
  int chain_count_ = 0;
  std::int64_t warmup_steps_ = 0;
};

}  // namespace patina
