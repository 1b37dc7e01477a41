#pragma once

#include <cstdint>
#include <vector>

#include "gui/plot/plot_axis.h"

namespace patina {

/// How many values fall into each of equal bins of a range, of all values and of those that are marked.
class Histogram {
 public:
  Histogram() = default;
  Histogram(const PlotRange& range, int bins);

  /// Counts a value if it lies in the range (its low end included, its high end not).
  void add(double value, bool marked);

  int bins() const { return static_cast<int>(all_.size()); }
  std::uint32_t all(int bin) const { return all_[static_cast<std::size_t>(bin)]; }
  std::uint32_t marked(int bin) const { return marked_[static_cast<std::size_t>(bin)]; }
  const std::vector<std::uint32_t>& counts() const { return all_; }
  std::uint32_t peak() const { return peak_; }  ///< values in the fullest bin
  const PlotRange& range() const { return range_; }

 private:
  PlotRange range_;
  std::vector<std::uint32_t> all_, marked_;
  std::uint32_t peak_ = 0;
};

}  // namespace patina
