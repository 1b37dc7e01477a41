#pragma once

#include <Eigen/Core>

#include <memory>
#include <vector>

#include "engine/posterior/emulator.h"
#include "engine/posterior/informed_density.h"
#include "engine/sampling/kernel.h"

namespace patina {

class VettedDensity;

/// What an emulator takes a target for, and proposals by it.
class EmulatedProposals {
 public:
  /// @param informed  the target's coordinates that are emulated   @param target  outlives this
  EmulatedProposals(const Emulator& emulator, const std::vector<Eigen::Index>& informed,
                    const LogDensity& target);
  EmulatedProposals(const EmulatedProposals&) = delete;  // its density refers to it
  EmulatedProposals& operator=(const EmulatedProposals&) = delete;

  /// Fifty HMC transitions, which need no render, propose; the target, evaluated once, takes or refuses
  /// (make_two_stage). Outlived by this.
  std::unique_ptr<Kernel> far(double path_length) const;
  std::unique_ptr<Kernel> near(double path_length) const;  ///< one transition proposes

  /// So many transitions over and over, until a target that is nowhere above the emulator's density takes
  /// where they have come to (make_rejection). Outlived by this.
  std::unique_ptr<Kernel> until_taken(double path_length) const;

 private:
  static constexpr int kMovesFar = 50, kMovesApart = 25;
  std::unique_ptr<Kernel> moves(double path_length) const;  ///< one transition

  Emulator emulator_;
  InformedDensity density_;
};

/// Moves of a target that need no gradient, along jagged coordinates as well: a random walk and refresh
/// moves.
std::unique_ptr<Kernel> make_walk_of(const LogDensity& target);

/// Now and then from one side of an emulator that has sides to the other, else by the kernel.
std::unique_ptr<Kernel> with_mirror_moves(std::unique_ptr<Kernel> kernel, Eigen::Index coordinate);

/// An emulator for proposals, its likelihood to a power below one: from tails that are too heavy a way leads
/// back. The nearer it follows the renders, the less is needed.
Emulator for_proposals(const Emulator& emulator);

/// Many HMC transitions under the emulator, a little softened, propose, the target, evaluated once, takes or
/// refuses (make_two_stage); and now and then a walk under the target itself, of all scales where it is
/// jagged, leaves where the emulator thinks too little of a place. Places of textures and levels are proposed
/// from their prior.
/// @param emulator  of the informed coordinates of the target   @param path_length  as of hmc (kernels.h)
std::unique_ptr<Kernel> make_emulated_kernel(const Emulator& emulator,
                                             const std::vector<Eigen::Index>& informed,
                                             const LogDensity& target, double path_length);

/// Of an average over irregularities, which is nowhere above its emulator: rejection sampling, so that draws
/// hardly depend on each other and no chain stays anywhere.
/// @param target  outlives the kernel
std::unique_ptr<Kernel> make_emulated_kernel(const VettedDensity& target, double path_length);

}  // namespace patina
