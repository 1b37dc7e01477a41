#include "engine/sampling/noise.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/sampling/finite_evaluation.h"
#include "engine/sampling/parallel_for.h"

namespace patina {

double value_noise(const LogDensity& target, const Position& place, int repeats, int threads,
                   const std::function<void()>& enter_thread) {
  if (repeats < 2) return 0;
  Eigen::ArrayXd values(repeats);
  const auto evaluate = [&](std::size_t i) {
    values[static_cast<Eigen::Index>(i)] = value_finite(target, place).log_density;
  };
  parallel_for(static_cast<std::size_t>(repeats), threads, evaluate, enter_thread);
  if ((values == values[0]).all()) return 0;
  if (!values.isFinite().all()) return std::numeric_limits<double>::infinity();
  return std::sqrt((values - values.mean()).square().sum() / (repeats - 1));
}

}  // namespace patina
