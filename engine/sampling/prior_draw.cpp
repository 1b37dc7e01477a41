#include "engine/sampling/prior_draw.h"

#include <utility>

#include "engine/sampling/finite_evaluation.h"

namespace patina {

Eigen::VectorXi draw_levels(const std::vector<int>& levels, Rng& rng) {
  Eigen::VectorXi drawn(std::ssize(levels));
  for (std::size_t i = 0; i < levels.size(); ++i) drawn[static_cast<Eigen::Index>(i)] = rng.below(levels[i]);
  return drawn;
}

Position prior_draw(const LogDensity& target, Rng& rng) {
  Eigen::VectorXd continuous = rng.normals(target.dimension());
  return {std::move(continuous), draw_levels(target.discrete_levels(), rng)};
}

ChainState prior_state(const LogDensity& target, Rng& rng) {
  Position position = prior_draw(target, rng);
  Evaluation evaluation = value_finite(target, position);
  return {std::move(position), std::move(evaluation)};
}

}  // namespace patina
