#include "engine/run/state_fits.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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

bool fits(const std::vector<double>& betas, int rungs) {
  if (std::ssize(betas) != rungs || betas.back() != 1) return false;
  return rungs == 1 || (betas[0] == 0 && betas[1] > 0 && std::ranges::is_sorted(betas));
}

bool fits(const TemperedState& state, const LogDensity& target, int rungs) {
  if (std::ssize(state.rungs) != rungs || state.from_prior.size() != state.rungs.size()) return false;
  // What lies on the prior's rung is drawn anew before anyone looks at it, and may have no density.
  if (!std::ranges::all_of(state.rungs.begin() + (rungs > 1), state.rungs.end(),
                           [&](const ChainState& rung) { return fits(rung, target); }))
    return false;
  std::vector<int> everyone(state.rungs.size());
  std::iota(everyone.begin(), everyone.end(), 0);
  return state.rounds >= 0 && std::ranges::is_permutation(state.traveller, everyone);
}

bool fits(const std::vector<ChainWarmup>& warmups, const LogDensity& target, int rungs) {
  return std::ssize(warmups) == std::max(rungs - 1, 1) &&
         std::ranges::all_of(warmups, [&](const ChainWarmup& warmup) {
           return fits(warmup.settings(), target) && warmup.has_dimension(target.dimension());
         });
}

bool fits(const LadderSettings& settings, const LogDensity& target, int rungs) {
  return fits(settings.betas, rungs) && std::ssize(settings.rungs) == std::max(rungs - 1, 1) &&
         std::ranges::all_of(settings.rungs, [&](const KernelSettings& rung) { return fits(rung, target); });
}

}  // namespace patina
