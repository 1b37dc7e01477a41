#include "gui/plot/credible_regions.h"

#include <algorithm>
#include <cmath>

#include "gui/plot/density_levels.h"

namespace patina {
namespace {

constexpr int kCells = 96;  // a side
constexpr double kLeastDraws = 20;
constexpr double kLeastSmoothing = 0.7;  // cells; below it the cells themselves would show

/// The mean and covariance of the answer's places in a plot.
struct Moments {
  double count = 0, mean_x = 0, mean_y = 0, xx = 0, xy = 0, yy = 0;

  void add(double x, double y) {
    const double dx = x - mean_x, dy = y - mean_y;
    mean_x += dx / ++count;
    mean_y += dy / count;
    xx += dx * (x - mean_x);
    xy += dx * (y - mean_y);
    yy += dy * (y - mean_y);
  }
};

/// Coordinates in which the cloud has variance 1 either way and no correlation: u along x alone, v what is
/// left of y.
class Whitening {
 public:
  explicit Whitening(const Moments& m)
      : x_(m.mean_x),
        y_(m.mean_y),
        u_to_x_(std::sqrt(m.xx / m.count)),
        u_to_y_(m.xy / m.count / u_to_x_),
        // Where one parameter tells the other, the region is a line; it is seen as a thin one.
        v_to_y_(std::sqrt(std::max(m.yy / m.count - u_to_y_ * u_to_y_, 1e-6 * m.yy / m.count))) {}

  PlotPlace to_cloud(PlotPlace at) const {
    const double u = (at.x - x_) / u_to_x_;
    return {u, (at.y - y_ - u * u_to_y_) / v_to_y_};
  }
  PlotPlace to_plot(PlotPlace at) const {
    return {x_ + at.x * u_to_x_, y_ + at.x * u_to_y_ + at.y * v_to_y_};
  }

 private:
  double x_, y_, u_to_x_, u_to_y_, v_to_y_;
};

/// A grid's cells along one coordinate of the cloud.
struct GridSide {
  double low = 0, cell = 1;
  int index(double value) const { return static_cast<int>((value - low) / cell); }
  double value(double cells) const { return low + cells * cell; }
};

/// Calls visit(place) for every draw of the answer that has a place in the plot.
template <typename Visit>
void each_place(const ExplorerModel& model, const PlotAxis& x, const PlotAxis& y, Visit visit) {
  const DrawColumns& draws = model.draws();
  for (std::size_t draw = 0; draw < draws.size(); ++draw) {
    const PlotPlace at{draws.place(x, draw), draws.place(y, draw)};
    if (model.in_answer(draw) && std::isfinite(at.x) && std::isfinite(at.y)) visit(at);
  }
}

/// A side from the lowest to the highest value, with room for what smoothing carries beyond.
GridSide side_over(const PlotRange& range, double bandwidth) {
  return {range.low - 3 * bandwidth, (range.span() + 6 * bandwidth) / kCells};
}

}  // namespace

CredibleRegions::Edges credible_regions(const ExplorerModel& model, const PlotAxis& x, const PlotAxis& y,
                                        std::optional<double> worth) {
  Moments moments;
  each_place(model, x, y, [&](PlotPlace at) { moments.add(at.x, at.y); });
  if (moments.count < kLeastDraws || !(moments.xx > 0) || !(moments.yy > 0)) return {};

  const Whitening whitening(moments);
  PlotRange u{0, 0}, v{0, 0};
  each_place(model, x, y, [&](PlotPlace at) {
    const PlotPlace place = whitening.to_cloud(at);
    u = {std::min(u.low, place.x), std::max(u.high, place.x)};
    v = {std::min(v.low, place.y), std::max(v.high, place.y)};
  });
  const double independent = std::clamp(worth.value_or(moments.count), kLeastDraws, moments.count);
  const double bandwidth = std::pow(independent, -1.0 / 6);
  const GridSide columns = side_over(u, bandwidth), rows = side_over(v, bandwidth);
  Image counts(kCells, kCells, 1);
  each_place(model, x, y, [&](PlotPlace at) {
    const PlotPlace place = whitening.to_cloud(at);
    counts.at(rows.index(place.y), columns.index(place.x), 0) += 1;
  });

  const Image density = smoothed_counts(counts, std::max(kLeastSmoothing, bandwidth / columns.cell),
                                        std::max(kLeastSmoothing, bandwidth / rows.cell));
  const auto levels = highest_density_levels(density, CredibleRegions::kShares);
  CredibleRegions::Edges edges;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    edges[i] = contour_lines(density, levels[i]);
    for (ContourPiece& piece : edges[i]) {
      const PlotPlace from = whitening.to_plot({columns.value(piece.x0), rows.value(piece.y0)}),
                      to = whitening.to_plot({columns.value(piece.x1), rows.value(piece.y1)});
      piece = {from.x, from.y, to.x, to.y};
    }
  }
  return edges;
}

const CredibleRegions::Edges& CredibleRegions::follow(const ExplorerModel& model, int run, const PlotAxis& x,
                                                      const PlotAxis& y, std::optional<double> worth) {
  const std::size_t all = model.draws().size(), sampled = model.draws().sampling_count();
  const std::size_t draws = sampled > 0 ? sampled : all;
  const double known = worth.value_or(0);
  const bool same =
      run == run_ && x == x_ && y == y_ && draws >= draws_ && std::abs(known - worth_) <= 0.25 * worth_;
  if (same && draws - draws_ <= draws_ / 50) return edges_;
  edges_ = credible_regions(model, x, y, worth);
  run_ = run, x_ = x, y_ = y, draws_ = draws, worth_ = known;
  return edges_;
}

}  // namespace patina
