#pragma once

#include <Eigen/Core>

#include <functional>
#include <vector>

#include "engine/sampling/chain_state.h"
#include "engine/sampling/log_density.h"

namespace patina {

struct MirrorSettings {
  std::vector<Eigen::Index> coordinates;    ///< along which to look
  int threads = 1;                          ///< at a time; the result is the same
  std::function<void()> enter_thread = {};  ///< called first on each of those threads
};

/// Where a symmetry of the target, exact or not, may have put another basin: images of a place, mirrored in
/// the middle of one coordinate's prior, that lie several sds away and not hopelessly deep. Climbs and walks
/// from the place do not come there. (Rings of wood may open upwards or downwards: wood_3's posterior has
/// both, and a run drew from one of them, by seed.)
/// @param place  good, with its log density   @param sds  of the target about it, a coordinate each, about
/// @return       least deep first, values alone
std::vector<ChainState> mirror_images(const LogDensity& target, const ChainState& place,
                                      const Eigen::VectorXd& sds, const MirrorSettings& settings);

}  // namespace patina
