#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gui/draw_columns.h"
#include "gui/plot/histogram.h"

namespace patina {

/// How the draws after warm-up spread over each parameter's range: counts that grow with the draws.
class ParameterHistograms {
 public:
  static constexpr int kBins = 48;  ///< of a continuous parameter

  /// @param ranges  of the continuous parameters; draws beyond them count at the ends
  explicit ParameterHistograms(const ParameterTable& table = {}, const std::vector<PlotRange>& ranges = {});

  /// Takes in draws that it has not seen, in their order. @param most  at once
  /// @return whether it has seen all
  bool follow(const DrawColumns& draws, std::size_t most);

  std::uint64_t total() const { return total_; }  ///< draws that count
  const std::vector<std::uint32_t>& continuous(std::size_t parameter) const {
    return continuous_[parameter].counts();
  }
  const std::vector<std::uint32_t>& discrete(std::size_t parameter) const { return levels_[parameter]; }

 private:
  void add(const DrawColumns& draws, std::size_t draw);

  std::vector<Histogram> continuous_;
  std::vector<std::vector<std::uint32_t>> levels_;
  std::size_t seen_ = 0;
  std::uint64_t total_ = 0;
};

}  // namespace patina
