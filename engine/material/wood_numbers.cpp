#include "engine/material/wood_numbers.h"

#include <Eigen/Core>
#include <cassert>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/AutoDiff>

namespace patina::wood {
namespace {

constexpr double kDarkest = 1e-20;  // a colour whose logarithm is a number

/// A number and its derivatives by all parameters.
using Number = Eigen::AutoDiffScalar<Eigen::Matrix<double, kParameters, 1>>;

Number at_least(const Number& x, double least) { return x.value() < least ? Number(least) : x; }
Number at_most(const Number& x, double most) { return x.value() > most ? Number(most) : x; }

/// The trapezoid that a RingProfile is (growth_rings.cpp): end, top, rise, fall, mean.
std::array<Number, 5> ring_of(const Number& earlywood_ramp, const Number& latewood_ramp,
                              const Number& latewood_fraction) {
  const Number end = latewood_fraction + latewood_ramp;
  const Number top = at_most(end / (earlywood_ramp + latewood_ramp), 1);
  const Number rise = top * earlywood_ramp, fall = top * latewood_ramp;
  const Number rising = at_most(rise, 1);
  const Number fell = at_least(1 - end + fall, 0), falling = fell.value() > fall.value() ? fall : fell;
  const Number after = at_least(1 - end, 0);
  const Number mean =
      top * (rising * rising / (2 * rise) - rising + 1 - falling * falling / (2 * fall) - after);
  return {end, top, rise, fall, mean};
}

struct Share {
  std::size_t level;
  Number share;
};

/// As value_noise.cpp's: the one or two levels that a width lies at or between.
std::vector<Share> shares_of(const Number& width, std::size_t levels) {
  const Number level = log(width) / std::numbers::ln2 + kLevelSharpness;
  if (!(level.value() > 0)) return {{0, Number(1)}};
  if (level.value() >= static_cast<double>(levels - 1)) return {{levels - 1, Number(1)}};
  const Number coarser = level - std::floor(level.value());
  const auto finer = static_cast<std::size_t>(level.value());
  return {{finer, 1 - coarser}, {finer + 1, coarser}};
}

class Collector {
 public:
  template <class... Values>
  void add(std::size_t place, const Values&... numbers) {
    assert(numbers_.values.size() == place);
    static_cast<void>(place);
    (add_one(numbers), ...);
  }

  /// @return the planes, whose weights are added
  std::vector<Level> add_mixture(const ValueNoise& noise, const Number& width_x, const Number& width_y) {
    std::vector<Level> planes;
    for (const Share& row : shares_of(width_y, noise.levels.size()))
      for (const Share& column : shares_of(width_x, noise.levels.front().size())) {
        planes.push_back({column.level, row.level});
        add_one(Number(row.share * column.share));
      }
    return planes;
  }

  Numbers& numbers() { return numbers_; }

 private:
  void add_one(const Number& number) {
    numbers_.values.push_back(number.value());
    Numbers::Slopes& slopes = numbers_.by_parameters.emplace_back();
    for (std::size_t i = 0; i < kParameters; ++i)
      slopes[i] = number.derivatives()[static_cast<Eigen::Index>(i)];
  }
  Numbers numbers_;
};

}  // namespace

Numbers numbers_of(const std::array<double, kParameters>& parameters, const WoodNoise& noise,
                   double pixel_cm) {
  std::array<Number, kParameters> p;
  for (std::size_t i = 0; i < kParameters; ++i)
    p[i] = Number(parameters[i], kParameters, static_cast<Eigen::Index>(i));
  const Number radians = p[kCutAngle] * (std::numbers::pi / 180), sine = sin(radians);
  const std::array<Number, 5> ring = ring_of(p[kEarlywoodRamp], p[kLatewoodRamp], p[kLatewoodFraction]);
  const auto latewood = [&](std::size_t channel) {
    return Number(exp(p[kLatewoodPower] * Number(log(at_least(p[kAlbedo + channel], kDarkest)))));
  };

  Collector all;
  all.add(kCut, p[kCentre], p[kCentre + 1], p[kCentre + 2], sine, Number(cos(radians)));
  all.add(kGnarl, p[kGnarlScale], p[kGnarlAmplitude]);
  all.add(kGrowth, p[kGrowthScale], p[kGrowthAmplitude], at_least(p[kRingSize], kThinnestRing));
  all.add(kRing, ring[0], ring[1], ring[2], ring[3], ring[4]);
  all.add(kStreaks, p[kCentre], p[kCentre + 1], p[kStreakScale], p[kStreakPower]);
  all.add(kContrast, p[kAlbedo], p[kAlbedo + 1], p[kAlbedo + 2], latewood(0), latewood(1), latewood(2),
          p[kLatewoodHeight], p[kRough], p[kEarlywoodRough]);
  const Number growth_width = at_least(p[kGrowthScale] * pixel_cm, kThinnestPixel);
  all.numbers().ring_planes = all.add_mixture(noise.ring_widths, growth_width, growth_width);
  const Number width = p[kStreakScale] * pixel_cm;
  const Number stretched = at_least(width * (sine.value() < 0 ? Number(-sine) : sine), kThinnestPixel);
  all.numbers().streak_planes = all.add_mixture(noise.streaks, width, stretched);
  return all.numbers();
}

std::array<double, kParameters> by_parameters(const Numbers& numbers, const std::vector<double>& by_numbers) {
  assert(by_numbers.size() == numbers.values.size());
  std::array<double, kParameters> sums{};
  for (std::size_t k = 0; k < by_numbers.size(); ++k)
    for (std::size_t i = 0; i < kParameters; ++i) sums[i] += by_numbers[k] * numbers.by_parameters[k][i];
  return sums;
}

}  // namespace patina::wood
