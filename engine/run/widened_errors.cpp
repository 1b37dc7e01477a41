#include "engine/run/widened_errors.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/posterior/simulate.h"
#include "engine/posterior/wider_errors.h"
#include "engine/run/controlled_density.h"
#include "engine/run/threads.h"
#include "engine/sampling/best_first.h"
#include "engine/sampling/mirror_images.h"
#include "engine/sampling/optimizer.h"
#include "engine/sampling/parallel_for.h"

namespace patina {
namespace {

WiderErrors measure(const Posterior& by_hand, const Position& match, IrregularityPool& pool,
                    std::uint64_t seed, RunShared& shared) {
  const Camera camera{.least_side = 0};  // no predictor looks at these photos
  shared.edit_status([](RunStatus& status) { status.message = "measuring what irregularities do"; });
  const Simulator simulator{.posterior = by_hand,
                            .pool = pool,
                            .camera = camera,
                            .seed = seed,
                            .threads = hardware_threads(),
                            .enter_thread = [] { use_tensor_threads(1); },
                            .simulated = [&] { shared.control.checkpoint(); }};
  return errors_of_irregularities(simulator, match);
}

/// Whether an image has not climbed back.
bool is_beyond(const Eigen::VectorXd& image, const Eigen::VectorXd& place, const Eigen::VectorXd& sds) {
  constexpr double kApart = 2;  // sds
  const auto other_side = image.array() * place.array() < 0;
  return (other_side && (image - place).array().abs() > kApart * sds.array()).any();
}

}  // namespace

std::vector<OptimizerResult> climb_on(const LogDensity& target, const std::vector<Position>& ends) {
  constexpr std::size_t kMost = 4;  // those behind were far behind, too
  OptimizerSettings settings;
  settings.max_iterations = 30;  // what polynomials are learnt about need not be the very top
  std::vector<OptimizerResult> climbed(std::min(ends.size(), kMost));
  parallel_for(
      climbed.size(), hardware_threads(),
      [&](std::size_t i) { climbed[i] = maximize(target, ends[i], settings); },
      [] { use_tensor_threads(1); });
  sort_best_first(climbed);
  return climbed;
}

std::vector<OptimizerResult> climbed_images(const LogDensity& target, const ChainState& best,
                                            const Metric& laplace,
                                            const std::vector<Eigen::Index>& coordinates) {
  constexpr std::size_t kMost = 2;
  const Eigen::VectorXd sds = laplace.covariance().diagonal().cwiseSqrt();
  std::vector<Position> images;
  for (ChainState& image :
       mirror_images(target, best, sds, {coordinates, hardware_threads(), [] { use_tensor_threads(1); }}))
    if (images.size() < kMost) images.push_back(std::move(image.position));
  std::vector<OptimizerResult> climbed = climb_on(target, images);
  std::erase_if(climbed, [&](const OptimizerResult& end) {
    return !is_beyond(end.position.continuous, best.position.continuous, sds);
  });
  return climbed;
}

ModeFound widened(const Posterior& by_hand, const std::vector<Position>& found, IrregularityPool& pool,
                  std::uint64_t seed, RunShared& shared) {
  assert(!found.empty());
  WiderErrors wider = measure(by_hand, found.front(), pool, seed, shared);
  const Posterior posterior = by_hand.with(wider);
  const ControlledDensity target(posterior, shared.control);
  std::vector<OptimizerResult> climbed = climb_on(target, found);
  ModeFound again = mode_of(posterior, climbed, shared);
  for (OptimizerResult& image :
       climbed_images(target, again.mode, *again.laplace, posterior.of_either_sign()))
    climbed.push_back(std::move(image));
  sort_best_first(climbed);
  if (climbed.front().evaluation.log_density > again.mode.evaluation.log_density)
    again = mode_of(posterior, climbed, shared);
  again.basins = basins_of(posterior, climbed);
  again.wider = std::move(wider);
  return again;
}

}  // namespace patina
