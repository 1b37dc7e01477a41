#include "engine/posterior/simulate.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/sampling/parallel_for.h"
#include "engine/sampling/prior_draw.h"
#include "engine/sampling/rng.h"

namespace patina {
namespace {

/// Photos whose summaries are made together: of small ones a batch of four takes a thread half the time of
/// four by themselves (bench-batch), and more gain no more.
constexpr Eigen::Index kInOnePass = 4;

constexpr std::uint64_t kDiscrepancies = 0x6469'7363'0000'0000;  // streams of no photo

void add_discrepancy(const Simulator& simulator, std::uint64_t stream, SimulatedPhotos& photos) {
  const Eigen::VectorXd sds = simulator.errors();
  Rng rng(simulator.seed, kDiscrepancies + stream);
  photos.errors.resize(sds.size(), photos.summaries.cols());
  for (auto errors : photos.errors.colwise()) errors = sds.cwiseProduct(rng.normals(sds.size()));
  photos.summaries += photos.errors;
}

}  // namespace

Eigen::VectorXi levels_of(const Posterior& posterior, const Irregularities& z) {
  Rng rng(z.seed());
  return prior_draw(posterior, rng).discrete;
}

Eigen::VectorXd Simulator::errors() const { return discrepancy * posterior.hand_set_errors(); }

SimulatedPhotos simulate(const Simulator& simulator, const Region& region, int photos, std::uint64_t stream) {
  const Posterior& posterior = simulator.posterior;
  const auto informed = posterior.informed();
  const Eigen::Index entries = posterior.photo_summary().size();
  SimulatedPhotos simulated{region, Eigen::MatrixXd(std::ssize(informed), photos),
                            Eigen::MatrixXd(entries, photos), Eigen::MatrixXd(entries, 0),
                            Eigen::MatrixXd(simulator.guess ? std::ssize(informed) : 0, photos)};
  const auto one = [&](Eigen::Index column) {
    const std::uint64_t which = stream * 1'000'000 + static_cast<std::uint64_t>(column);
    Rng rng(simulator.seed, which);
    const auto z = simulator.pool[simulator.seed * 10'000'000 + which];
    Position position{rng.normals(posterior.dimension()), levels_of(posterior, *z)};
    simulated.offsets.col(column) = position.continuous(informed);
    position.continuous(informed) = region.place(simulated.offsets.col(column));
    Image photo = posterior.simulated_photo(position, *z, simulator.camera, rng);
    if (simulator.guess) simulated.guesses.col(column) = simulator.guess.centre(photo);
    if (simulator.simulated) simulator.simulated();
    return photo;
  };
  const auto several = [&](std::size_t pass) {
    const Eigen::Index first = kInOnePass * static_cast<Eigen::Index>(pass);
    std::vector<Image> taken;
    for (Eigen::Index i = first; i < std::min<Eigen::Index>(first + kInOnePass, photos); ++i)
      taken.push_back(one(i));
    simulated.summaries.middleCols(first, std::ssize(taken)) = posterior.simulated_summaries(taken);
  };
  const auto passes = static_cast<std::size_t>((photos + kInOnePass - 1) / kInOnePass);
  if (simulator.threads > 1)
    parallel_for(passes, simulator.threads, several, simulator.enter_thread);
  else
    for (std::size_t i = 0; i < passes; ++i) several(i);
  if (simulator.discrepancy > 0) add_discrepancy(simulator, stream, simulated);
  return simulated;
}

}  // namespace patina
