#include "engine/sampling/prior_draw.h"

#include <utility>
#include <vector>

#include "engine/sampling/finite_evaluation.h"

namespace patina {

Position prior_draw(const LogDensity& target, Rng& rng) {
  const std::vector<int> levels = target.discrete_levels();
  Position drawn{rng.normals(target.dimension()), Eigen::VectorXi(std::ssize(levels))};
  for (std::size_t i = 0; i < levels.size(); ++i)
    drawn.discrete[static_cast<Eigen::Index>(i)] = rng.below(levels[i]);
  return drawn;
}

ChainState prior_state(const LogDensity& target, Rng& rng) {
  Position position = prior_draw(target, rng);
  Evaluation evaluation = value_finite(target, position);
  return {std::move(position), std::move(evaluation)};
}

}  // namespace patina
