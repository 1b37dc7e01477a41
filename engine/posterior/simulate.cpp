#include "engine/posterior/simulate.h"

#include <utility>

#include "engine/sampling/parallel_for.h"
#include "engine/sampling/prior_draw.h"
#include "engine/sampling/rng.h"

namespace patina {
namespace {

constexpr std::uint64_t kDiscrepancies = 0x6469'7363'0000'0000;  // streams of no photo

/// The levels that irregularities are shown at: always the same, so that few maps are kept.
Eigen::VectorXi levels_of(const Posterior& posterior, const Irregularities& z) {
  Rng rng(z.seed());
  return prior_draw(posterior, rng).discrete;
}

}  // namespace

SimulatedPhotos simulate(const Simulator& simulator, const Region& region, int photos, std::uint64_t stream) {
  const Posterior& posterior = simulator.posterior;
  const auto informed = posterior.informed();
  const Eigen::Index entries = posterior.photo_summary().size();
  SimulatedPhotos simulated{region, Eigen::MatrixXd(std::ssize(informed), photos),
                            Eigen::MatrixXd(entries, photos),
                            Eigen::MatrixXd(simulator.guess ? std::ssize(informed) : 0, photos)};
  const auto one = [&](std::size_t i) {
    const auto column = static_cast<Eigen::Index>(i);
    const std::uint64_t which = stream * 1'000'000 + i;
    Rng rng(simulator.seed, which);
    const auto z = simulator.pool[simulator.seed * 10'000'000 + which];
    Position position{rng.normals(posterior.dimension()), levels_of(posterior, *z)};
    simulated.offsets.col(column) = position.continuous(informed);
    position.continuous(informed) = region.place(simulated.offsets.col(column));
    const Image photo = posterior.simulated_photo(position, *z, simulator.camera, rng);
    simulated.summaries.col(column) = posterior.simulated_summary(photo);
    if (simulator.guess) simulated.guesses.col(column) = simulator.guess.centre(photo);
    if (simulator.simulated) simulator.simulated();
  };
  const auto count = static_cast<std::size_t>(photos);
  if (simulator.threads > 1)
    parallel_for(count, simulator.threads, one, simulator.enter_thread);
  else
    for (std::size_t i = 0; i < count; ++i) one(i);
  return with_discrepancy(simulator, std::move(simulated), stream);
}

SimulatedPhotos with_discrepancy(const Simulator& simulator, SimulatedPhotos photos, std::uint64_t stream) {
  if (simulator.discrepancy == 0) return photos;
  const Eigen::VectorXd sd = simulator.discrepancy * simulator.posterior.hand_set_errors();
  Rng rng(simulator.seed, kDiscrepancies + stream);
  for (Eigen::Index i = 0; i < photos.summaries.cols(); ++i)
    photos.summaries.col(i) += sd.cwiseProduct(rng.normals(sd.size()));
  return photos;
}

}  // namespace patina
