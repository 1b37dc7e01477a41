#include "engine/run/photo_alarms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

namespace patina {
namespace {

constexpr int kCells = 16;  // a side

std::string whole_percent(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

double luminance(const Image& photo, int row, int column) {
  return 0.2126 * photo.at(row, column, 0) + 0.7152 * photo.at(row, column, 1) +
         0.0722 * photo.at(row, column, 2);
}

/// The share of pixels that `is` says yes to.
template <typename Is>
double share_of(const Image& photo, Is is) {
  std::size_t count = 0;
  for (int row = 0; row < photo.height; ++row)
    for (int column = 0; column < photo.width; ++column) count += is(row, column);
  return static_cast<double>(count) / (static_cast<double>(photo.height) * photo.width);
}

std::optional<Alarm> dark(const Image& photo) {
  constexpr double kBlack = 8.0 / 255, kMost = 0.9;
  const double share =
      share_of(photo, [&](int row, int column) { return luminance(photo, row, column) < kBlack; });
  if (share < kMost) return std::nullopt;
  return Alarm{"dark", whole_percent(share) +
                           " of the photo is black: it says little about the material. Take it "
                           "with more light or a longer exposure."};
}

std::optional<Alarm> burnt_out(const Image& photo) {
  constexpr double kWhite = 254.5 / 255, kMost = 0.25;
  const double share = share_of(photo, [&](int row, int column) {
    return std::max({photo.at(row, column, 0), photo.at(row, column, 1), photo.at(row, column, 2)}) > kWhite;
  });
  if (share < kMost) return std::nullopt;
  return Alarm{"burnt out", whole_percent(share) +
                                " of the photo is as bright as it can be, and what differs there "
                                "is lost. Take it with a shorter exposure."};
}

/// Pixels of each 8-bit level of a channel.
std::array<int, 256> histogram(const Image& photo, int channel) {
  std::array<int, 256> counts{};
  for (int row = 0; row < photo.height; ++row)
    for (int column = 0; column < photo.width; ++column)
      ++counts[static_cast<std::size_t>(
          std::clamp(std::lround(255 * photo.at(row, column, channel)), 0L, 255L))];
  return counts;
}

/// The share of pixels that a channel has in its brightest levels, if so many more are there than in those
/// below; 0 where it reaches white, or hardly leaves black. A few pixels may be brighter: JPEG has ringing.
double plateau(const std::array<int, 256>& counts) {
  constexpr int kWhite = 250, kBlack = 64, kTop = 4, kBelow = 8;  // levels
  constexpr double kBrighter = 0.002, kSteep = 5;
  double total = 0;
  for (const int count : counts) total += count;
  int top = 255;
  for (double above = counts[255]; top > 0 && above < kBrighter * total;
       above += counts[static_cast<std::size_t>(top)])
    --top;
  if (top > kWhite || top < kBlack) return 0;
  const auto sum = [&](int from, int to) {
    return std::accumulate(counts.begin() + from, counts.begin() + to, 0.0);
  };
  const double share = sum(top - kTop + 1, 256), below = sum(top - kTop + 1 - kBelow, top - kTop + 1);
  return share > kSteep * below * kTop / kBelow ? share / total : 0;
}

/// Light that was lost in a highlight and darkened afterwards, in some channel or in all.
std::optional<Alarm> clipped(const Image& photo) {
  constexpr double kMost = 0.02;
  double share = 0;
  for (int channel = 0; channel < 3; ++channel) share = std::max(share, plateau(histogram(photo, channel)));
  if (share < kMost) return std::nullopt;
  return Alarm{"clipped",
               whole_percent(share) +
                   " of the photo is cut off at one brightness below white: it was burnt out there, and then "
                   "darkened or tinted. Use it as the camera took it, or with a shorter exposure."};
}

/// Mean luminance of kCells x kCells cells.
using Cells = std::array<std::array<double, kCells>, kCells>;

Cells cells_of(const Image& photo) {
  Cells sums{};
  std::array<std::array<int, kCells>, kCells> counts{};
  for (int row = 0; row < photo.height; ++row)
    for (int column = 0; column < photo.width; ++column) {
      const int i = row * kCells / photo.height, j = column * kCells / photo.width;
      sums[i][j] += luminance(photo, row, column);
      ++counts[i][j];
    }
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j) sums[i][j] /= std::max(counts[i][j], 1);
  return sums;
}

std::optional<Alarm> blank(const Image& photo) {
  constexpr double kNothing = 0.75 / 255;
  const std::size_t channels = 3;
  double widest = 0;
  for (std::size_t c = 0; c < channels; ++c) {
    float low = 1, high = 0;
    for (std::size_t i = c; i < photo.pixels.size(); i += channels) {
      low = std::min(low, photo.pixels[i]);
      high = std::max(high, photo.pixels[i]);
    }
    widest = std::max<double>(widest, high - low);
  }
  if (widest > kNothing) return std::nullopt;
  return Alarm{"blank",
               "Every pixel of the photo is the same: there is no texture and no highlight to match."};
}

/// How far from the middle the centre of what is brighter than the median is, in sides; and how much that is.
std::optional<Alarm> off_centre(const Image& photo) {
  constexpr double kFar = 0.23, kFlat = 0.05;
  const Cells cells = cells_of(photo);
  std::vector<double> sorted;
  for (const auto& row : cells) sorted.insert(sorted.end(), row.begin(), row.end());
  std::ranges::sort(sorted);
  const double median = sorted[sorted.size() / 2];
  if (sorted.back() - median < kFlat) return std::nullopt;
  double mass = 0, x = 0, y = 0;
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j) {
      const double weight = std::max(cells[i][j] - median, 0.0);
      mass += weight;
      x += weight * ((j + 0.5) / kCells - 0.5);
      y += weight * ((i + 0.5) / kCells - 0.5);
    }
  const double distance = std::hypot(x, y) / mass;
  if (distance < kFar) return std::nullopt;
  return Alarm{"off centre",
               "The photo is brightest " + whole_percent(distance) +
                   " of its side off the middle, where the flash is taken to be: crop it around "
                   "its highlight, or take it with the flash beside the camera."};
}

}  // namespace

Alarms photo_alarms(const Image& photo) {
  if (const auto alarm = blank(photo)) return {*alarm};
  Alarms alarms;
  for (const auto& alarm : {dark(photo), burnt_out(photo), clipped(photo), off_centre(photo)})
    if (alarm) alarms.push_back(*alarm);
  return alarms;
}

}  // namespace patina
