#include "engine/run/state_fits.h"

#include <cmath>
#include <vector>

namespace patina {

bool fits(const Position& position, const LogDensity& target) {
  const std::vector<int> levels = target.discrete_levels();
  if (position.discrete.size() != static_cast<Eigen::Index>(levels.size())) return false;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const int level = position.discrete[static_cast<Eigen::Index>(i)];
    if (level < 0 || level >= levels[i]) return false;
  }
  return position.continuous.size() == target.dimension() && position.continuous.allFinite();
}

bool fits(const ChainState& state, const LogDensity& target) {
  const Eigen::Index gradient = state.evaluation.gradient.size();  // 0: left out
  return fits(state.position, target) && std::isfinite(state.evaluation.log_density) &&
         (gradient == 0 || gradient == target.dimension());
}

bool fits(const std::shared_ptr<const Metric>& metric, const LogDensity& target) {
  return metric && metric->dimension() == target.dimension();
}

bool fits(const KernelSettings& settings, const LogDensity& target) {
  return fits(settings.metric, target) && settings.step_size > 0 &&
         (!settings.straightening || settings.straightening->dimension() == target.dimension());
}

}  // namespace patina
