#include "engine/diagnostics/modes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "engine/diagnostics/principal_directions.h"

namespace patina {
namespace {

using Rows = std::vector<Eigen::Index>;

constexpr double kGap = 0.25;        // of the lower side's density
constexpr double kLeastSide = 0.05;  // of the cloud that is cut
constexpr double kLeastMode = 0.02;  // of the sample
constexpr std::size_t kLeastDraws = 30;
constexpr int kPrincipal = 3;  // directions
constexpr int kBins = 128;

/// Where a cloud thins out along a direction.
struct Gap {
  double at = 0;
  double depth = 1;  ///< density there over that of the lower side's summit
};

/// A density on equal bins, smoothed by a Gaussian of so many bins.
std::vector<double> smoothed(const std::vector<double>& counts, double sd) {
  const int reach = static_cast<int>(std::ceil(3.5 * sd)), size = static_cast<int>(counts.size());
  std::vector<double> result(counts.size());
  for (int i = 0; i < size; ++i) {
    for (int j = std::max(0, i - reach); j <= std::min(size - 1, i + reach); ++j)
      result[i] += counts[j] * std::exp(-0.5 * (i - j) * (i - j) / (sd * sd));
  }
  return result;
}

/// The deepest gap of a sample of numbers that leaves enough of them on either side.
std::optional<Gap> deepest_gap(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t count = values.size();
  const auto least = std::max(kLeastDraws, static_cast<std::size_t>(kLeastSide * static_cast<double>(count)));
  if (count < 2 * least) return std::nullopt;
  const double low = values.front(), span = values.back() - low;
  const double middle_half = values[3 * count / 4] - values[count / 4];
  if (!(span > 0)) return std::nullopt;
  std::vector<double> counts(kBins);
  for (const double value : values)
    counts[std::min<std::size_t>(kBins - 1, static_cast<std::size_t>((value - low) / span * kBins))] += 1;
  // Half of Silverman's width (1986, 3.31), which is made for one cloud and would fill the gap between two.
  const double width = 0.45 * middle_half / 1.34 * std::pow(static_cast<double>(count), -0.2);
  const auto density = smoothed(counts, std::max(1.0, width / span * kBins));

  std::vector<double> highest_after(density);
  for (int i = kBins - 2; i >= 0; --i) highest_after[i] = std::max(density[i], highest_after[i + 1]);
  Gap best;
  double before = 0, highest_before = 0;
  for (int i = 0; i < kBins; ++i) {
    before += counts[i];
    highest_before = std::max(highest_before, density[i]);
    const double after = static_cast<double>(count) - before;
    if (before < static_cast<double>(least) || after < static_cast<double>(least)) continue;
    const double depth = density[i] / std::min(highest_before, highest_after[i]);
    if (depth < best.depth) best = {low + (i + 1) * span / kBins, depth};
  }
  return best;
}

Eigen::MatrixXd rows_of(const Eigen::MatrixXd& points, const Rows& rows) {
  Eigen::MatrixXd part(static_cast<Eigen::Index>(rows.size()), points.cols());
  for (std::size_t i = 0; i < rows.size(); ++i) part.row(static_cast<Eigen::Index>(i)) = points.row(rows[i]);
  return part;
}

/// From centre to centre of the two halves that 2-means finds, begun along `start`.
Eigen::VectorXd between_halves(const Eigen::MatrixXd& centred, const Eigen::VectorXd& start) {
  constexpr int kRounds = 10;
  Eigen::VectorXd direction = start;
  double cut = 0;
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::ArrayXd right = ((centred * direction).array() > cut).cast<double>();
    const double count = right.sum(), others = static_cast<double>(centred.rows()) - count;
    if (count == 0 || others == 0) return start;
    const Eigen::VectorXd sum = centred.transpose() * right.matrix();
    // The rows sum to zero.
    const Eigen::VectorXd a = sum / count, b = -sum / others;
    direction = a - b;
    cut = 0.5 * direction.dot(a + b);
  }
  return direction;
}

/// The directions along which a cloud is looked at, as columns.
Eigen::MatrixXd directions(const Eigen::MatrixXd& centred) {
  const Eigen::Index dimension = centred.cols();
  const auto principal = principal_directions(centred, kPrincipal);
  const auto count = static_cast<Eigen::Index>(principal.size());
  Eigen::MatrixXd result(dimension, dimension + 2 * count);
  result.leftCols(dimension).setIdentity();
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::VectorXd& axis = principal[static_cast<std::size_t>(i)].loadings;
    result.col(dimension + i) = axis;
    result.col(dimension + count + i) = between_halves(centred, axis);
  }
  return result;
}

/// A cloud in coordinates of variance 1; those that are constant in it become zero.
Eigen::MatrixXd standardised(Eigen::MatrixXd points) {
  points.rowwise() -= points.colwise().mean().eval();
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const double sd = std::sqrt(points.col(i).squaredNorm() / static_cast<double>(points.rows()));
    if (sd > 0) points.col(i) /= sd;
  }
  return points;
}

/// Cuts a cloud into those it falls into.
void separate(const Eigen::MatrixXd& points, const Rows& rows, std::vector<Mode>& modes) {
  const Eigen::MatrixXd cloud = standardised(rows_of(points, rows));
  const Eigen::MatrixXd seen = cloud * directions(cloud);
  Eigen::Index along = 0;
  Gap deepest;
  for (Eigen::Index i = 0; i < seen.cols(); ++i) {
    const Eigen::VectorXd column = seen.col(i);
    const auto gap = deepest_gap({column.data(), column.data() + column.size()});
    if (gap && gap->depth < deepest.depth) deepest = *gap, along = i;
  }
  if (deepest.depth >= kGap) {
    modes.push_back({rows});
    return;
  }
  Rows left, right;
  for (std::size_t i = 0; i < rows.size(); ++i)
    (seen(static_cast<Eigen::Index>(i), along) < deepest.at ? left : right).push_back(rows[i]);
  separate(points, left, modes);
  separate(points, right, modes);
}

}  // namespace

std::vector<Mode> find_modes(const Eigen::MatrixXd& continuous, const Eigen::MatrixXi& discrete) {
  std::map<std::vector<int>, Rows> choices;
  const Eigen::Index draws = std::max(continuous.rows(), discrete.rows());
  for (Eigen::Index draw = 0; draw < draws; ++draw) {
    std::vector<int> levels;
    for (Eigen::Index i = 0; i < discrete.cols(); ++i) levels.push_back(discrete(draw, i));
    choices[levels].push_back(draw);
  }
  std::vector<Mode> modes;
  for (const auto& [levels, rows] : choices) {
    if (continuous.cols() > 0) {
      separate(continuous, rows, modes);
    } else {
      modes.push_back({rows});
    }
  }
  const double least = std::max<double>(kLeastDraws, kLeastMode * static_cast<double>(draws));
  std::erase_if(modes, [&](const Mode& mode) { return static_cast<double>(mode.members.size()) < least; });
  std::ranges::stable_sort(modes, std::greater<>(), [](const Mode& mode) { return mode.members.size(); });
  return modes;
}

}  // namespace patina
