#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "gui/explorer_model.h"
#include "gui/plot/contour_lines.h"

namespace patina {

/// The edges of the smallest regions of a plot that hold half of the draws, and nine in ten: of a density
/// smoothed by a Gaussian of the draws' own covariance times n^(-1/3) (Scott 1992), n the independent
/// draws that they are worth; that widens a Gaussian cloud of 1000 by 5 %, one of 100,000 by 1 %. Draws of
/// warm-up are left out once there are others.
class CredibleRegions {
 public:
  static constexpr std::array<double, 2> kShares{0.5, 0.9};
  using Edges = std::array<std::vector<ContourPiece>, 2>;  ///< of each share, in the axes' units

  /// Brings the edges up to date where the axes changed, the draws became 2 % more, or `worth` became another
  /// by a quarter.
  /// @param run    tells one run's draws from another's
  /// @param worth  how many independent draws they are worth (ESS), as far as that is known
  const Edges& follow(const ExplorerModel& model, int run, const PlotAxis& x, const PlotAxis& y,
                      std::optional<double> worth = {});

 private:
  PlotAxis x_, y_;
  int run_ = -1;
  std::size_t draws_ = 0;  ///< that the edges are made from
  double worth_ = 0;       ///< likewise; 0: not known
  Edges edges_;
};

/// The edges themselves. None for fewer than 20 draws, or where all have one value along an axis.
CredibleRegions::Edges credible_regions(const ExplorerModel& model, const PlotAxis& x, const PlotAxis& y,
                                        std::optional<double> worth = {});

}  // namespace patina
