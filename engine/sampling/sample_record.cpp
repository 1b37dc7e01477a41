#include "engine/sampling/sample_record.h"

#include <algorithm>

namespace patina {

void SampleTally::add(const TransitionInfo& info) {
  if (info.move == MoveKind::continuous) accepted += info.accept_probability, ++continuous;
  divergences += info.divergent;
  evaluations += info.evaluations;
}

void shape(Sample& sample, const LogDensity& target, const SampleSettings& settings) {
  sample.energy.resize(settings.draws, settings.chains);
  sample.log_density = sample.energy;
  sample.divergent.resize(settings.draws, settings.chains);
  sample.coordinates.assign(static_cast<std::size_t>(target.dimension()), sample.energy);
  sample.levels.assign(target.discrete_levels().size(), sample.energy);
}

void record(Sample& sample, Eigen::Index t, Eigen::Index k, const ChainState& state,
            const TransitionInfo& info) {
  sample.energy(t, k) = info.energy;
  sample.divergent(t, k) = info.divergent;
  sample.log_density(t, k) = state.evaluation.log_density;
  for (std::size_t i = 0; i < sample.coordinates.size(); ++i)
    sample.coordinates[i](t, k) = state.position.continuous[static_cast<Eigen::Index>(i)];
  for (std::size_t i = 0; i < sample.levels.size(); ++i)
    sample.levels[i](t, k) = state.position.discrete[static_cast<Eigen::Index>(i)];
}

void add_tallies(Sample& sample, const std::vector<SampleTally>& tallies) {
  for (const SampleTally& tally : tallies) {
    sample.acceptance.push_back(tally.accepted / static_cast<double>(std::max(tally.continuous, 1L)));
    sample.divergences += tally.divergences;
    sample.evaluations += tally.evaluations;
  }
}

}  // namespace patina
