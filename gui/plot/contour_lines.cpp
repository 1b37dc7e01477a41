#include "gui/plot/contour_lines.h"

#include <array>
#include <cassert>

namespace patina {
namespace {

struct Point {
  double x, y;
};

/// A square between the middles of four cells: its corners in order around it.
struct Square {
  std::array<Point, 4> corners;
  std::array<double, 4> values;

  /// Where the level is passed on the side from corner `i` to the next.
  Point crossing(std::size_t i, double level) const {
    const std::size_t next = (i + 1) % 4;
    const double share = (level - values[i]) / (values[next] - values[i]);
    return {corners[i].x + share * (corners[next].x - corners[i].x),
            corners[i].y + share * (corners[next].y - corners[i].y)};
  }
};

/// Around every run of corners above the level goes one piece, from the side where the run begins to the side
/// where it ends; at a saddle there are two runs.
void add_pieces(const Square& square, double level, std::vector<ContourPiece>& pieces) {
  const auto above = [&](std::size_t i) { return square.values[i % 4] > level; };
  for (std::size_t first = 0; first < 4; ++first) {
    if (above(first) || !above(first + 1)) continue;
    std::size_t last = first + 1;
    while (above(last + 1)) ++last;
    const Point in = square.crossing(first, level), out = square.crossing(last % 4, level);
    pieces.push_back({in.x, in.y, out.x, out.y});
  }
}

}  // namespace

std::vector<ContourPiece> contour_lines(const Image& grid, double level) {
  assert(grid.channels == 1);
  const auto value = [&](int row, int column) -> double {
    const bool inside = row >= 0 && row < grid.height && column >= 0 && column < grid.width;
    return inside ? grid.at(row, column, 0) : 0;
  };
  std::vector<ContourPiece> pieces;
  for (int row = -1; row < grid.height; ++row) {
    for (int column = -1; column < grid.width; ++column) {
      const double x = column + 0.5, y = row + 0.5;
      const Square square{
          {Point{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}},
          {value(row, column), value(row, column + 1), value(row + 1, column + 1), value(row + 1, column)}};
      add_pieces(square, level, pieces);
    }
  }
  return pieces;
}

}  // namespace patina
