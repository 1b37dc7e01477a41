#include "engine/sampling/mirror_images.h"

#include <algorithm>
#include <cmath>

#include "engine/sampling/best_first.h"
#include "engine/sampling/finite_evaluation.h"
#include "engine/sampling/parallel_for.h"

namespace patina {

std::vector<ChainState> mirror_images(const LogDensity& target, const ChainState& place,
                                      const Eigen::VectorXd& sds, const MirrorSettings& settings) {
  constexpr double kApart = 3;       // sds: nearer images are of the same basin
  constexpr double kFar = 1;         // prior sds: to nearer ones a walk finds the way
  constexpr double kHopeless = 100;  // nats below the place: wood_3's are 18 to 60, and a climb ends above it
  std::vector<ChainState> images;
  for (const Eigen::Index i : settings.coordinates) {
    ChainState image{place.position, {}};
    double& u = image.position.continuous[i];
    if (2 * std::abs(u) < std::max(kApart * sds[i], kFar)) continue;
    u = -u;
    images.push_back(std::move(image));
  }
  parallel_for(
      images.size(), settings.threads,
      [&](std::size_t i) { images[i].evaluation = value_finite(target, images[i].position); },
      settings.enter_thread);
  std::erase_if(images, [&](const ChainState& image) {
    return !(image.evaluation.log_density > place.evaluation.log_density - kHopeless);
  });
  sort_best_first(images);
  return images;
}

}  // namespace patina
