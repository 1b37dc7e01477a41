#pragma once

#include <functional>

namespace patina {

struct Moments {
  double mean = 0, sd = 0;
};

/// Moments of a density on [low, high] that is given by its log up to a constant: the midpoint rule on so
/// many cells, which a jump at a cell's border does not harm.
Moments moments(const std::function<double(double)>& log_density, double low, double high,
                int cells = 200'000);

/// Moments of f(x) under it.
Moments moments_of(const std::function<double(double)>& f, const std::function<double(double)>& log_density,
                   double low, double high, int cells = 200'000);

/// N(mean, sd^2) cut to [low, high], in closed form.
Moments truncated_normal(double mean, double sd, double low, double high);

}  // namespace patina
