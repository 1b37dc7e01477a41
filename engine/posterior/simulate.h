#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <functional>

#include "engine/image.h"
#include "engine/posterior/camera.h"
#include "engine/posterior/irregularity_pool.h"
#include "engine/posterior/posterior.h"
#include "engine/posterior/region.h"

namespace patina {

/// Tells from a photo alone about where its posterior is, among the informed coordinates. May be empty.
struct Guess {
  std::function<Eigen::VectorXd(const Image&)> centre;
  std::function<Region(const Image&)> region;
  explicit operator bool() const { return centre != nullptr; }
};

/// How photos are simulated, and by whom.
struct Simulator {
  const Posterior& posterior;
  IrregularityPool& pool;
  Camera camera;
  std::uint64_t seed = 1;
  int threads = 1;                       ///< photos at a time, 1: the caller's; they are the same
  std::function<void()> enter_thread{};  ///< called first on each of those threads
  std::function<void()> simulated{};     ///< called after each photo, from any of them; may throw
  Guess guess{};
  /// Times the posterior's hand-set errors that photos are off by beside all else, as real ones are.
  double discrepancy = 0;
  Eigen::VectorXd errors() const;  ///< their sds
};

/// Photos simulated in a region, each with irregularities of its own. Places are drawn from their prior, and
/// so are levels, which all today's materials have for places.
struct SimulatedPhotos {
  Region region;
  Eigen::MatrixXd offsets;    ///< v, N(0, I): informed coordinates x n, see Region
  Eigen::MatrixXd summaries;  ///< entries x n, with what the discrepancy has added
  Eigen::MatrixXd errors;     ///< what it has added, entries x n; none without it
  Eigen::MatrixXd guesses;    ///< by Guess::centre, informed coordinates x n; none without it
};

/// The levels that irregularities are shown at: always the same, so that few maps are kept.
Eigen::VectorXi levels_of(const Posterior& posterior, const Irregularities& z);

/// @param stream  another one for other photos; the same gives the same ones, whatever their discrepancy
SimulatedPhotos simulate(const Simulator& simulator, const Region& region, int photos, std::uint64_t stream);

}  // namespace patina
