#include "engine/posterior/emulated_moves.h"

#include <functional>
#include <utility>

#include "engine/posterior/vetted_density.h"
#include "engine/sampling/kernels.h"

namespace patina {
namespace {

constexpr double kProposing = 0.9, kProposingIfJagged = 0.75;  // share of the proposals
constexpr double kNear = 0.25;                                 // of these, where the target is jagged
constexpr double kAlpha = 0.9;                                 // continuous moves, where there are levels

/// Far proposals alone, or near ones as well: what the emulator does not know of a jagged target is about the
/// same a step away, so that chains walk on where far proposals are refused.
std::unique_ptr<Kernel> proposing(const EmulatedProposals& proposals, const LogDensity& target,
                                  double path_length) {
  auto far = proposals.far(path_length);
  if (!has_jagged(target)) return far;
  return make_mixture(std::move(far), proposals.near(path_length), 1 - kNear);
}

/// Moves of the target that need no gradient, along jagged coordinates as well.
/// @param walk  of the continuous coordinates   @param refresh  share of these moves that are refresh moves
std::unique_ptr<Kernel> without_gradient(const LogDensity& target, std::unique_ptr<Kernel> walk,
                                         double refresh) {
  walk = make_mixture(std::move(walk), make_refresh_move(), 1 - refresh);
  if (target.discrete_levels().empty()) return walk;
  return make_mixture(std::move(walk), make_discrete_move(), kAlpha);
}

/// What leads on where the emulator knows little. Jagged targets have pits, as narrow as nowhere else, that
/// walks of all scales lead out of in half the time of trajectories by gradients (leather_6,
/// resources/charts).
std::unique_ptr<Kernel> way_out_of(const LogDensity& target) {
  if (!has_jagged(target)) return make_walk_of(target);
  return without_gradient(target, make_walk_of_all_scales(), usual_refresh(/*has_jagged=*/false));
}

/// A kernel of an emulator's proposals, which it keeps.
class EmulatedKernel final : public Kernel {
 public:
  using Made = std::function<std::unique_ptr<Kernel>(const EmulatedProposals&)>;
  EmulatedKernel(const Emulator& emulator, const std::vector<Eigen::Index>& informed,
                 const LogDensity& target, const Made& make)
      : proposals_(emulator, informed, target), kernel_(make(proposals_)) {}

  TransitionInfo step(const LogDensity& target, const KernelSettings& settings, ChainState& state,
                      Rng& rng) const override {
    return kernel_->step(target, settings, state, rng);
  }
  double target_acceptance() const override { return kernel_->target_acceptance(); }

 private:
  EmulatedProposals proposals_;
  std::unique_ptr<Kernel> kernel_;
};

}  // namespace

EmulatedProposals::EmulatedProposals(const Emulator& emulator, const std::vector<Eigen::Index>& informed,
                                     const LogDensity& target)
    : emulator_(emulator), density_(emulator_, informed, target) {}

/// Not straightened: the map that warm-up fits is no good in tails, and where it bends them chains stayed
/// for thousands of iterations (of 50 moves from leather_6's, a fifteenth led out, a fifth as soon
/// without).
std::unique_ptr<Kernel> EmulatedProposals::moves(double path_length) const {
  constexpr int kMostSteps = 24;
  constexpr double kCareful = 0.4;
  const double refresh = usual_refresh(/*has_jagged=*/false);
  auto kernel = make_mixture(make_hmc(path_length, kMostSteps, kCareful), make_refresh_move(), 1 - refresh);
  if (const auto sides = emulator_.sides())
    kernel = with_mirror_moves(std::move(kernel), density_.informed()[static_cast<std::size_t>(*sides)]);
  if (density_.discrete_levels().empty()) return kernel;
  return make_mixture(std::move(kernel), make_discrete_move(), kAlpha);
}

std::unique_ptr<Kernel> EmulatedProposals::far(double path_length) const {
  return make_two_stage(moves(path_length), density_, kMovesFar);
}

std::unique_ptr<Kernel> EmulatedProposals::near(double path_length) const {
  return make_two_stage(moves(path_length), density_, 1);
}

std::unique_ptr<Kernel> EmulatedProposals::until_taken(double path_length) const {
  return make_rejection(moves(path_length), density_, kMovesApart);
}

std::unique_ptr<Kernel> with_mirror_moves(std::unique_ptr<Kernel> kernel, Eigen::Index coordinate) {
  constexpr double kNotMirrored = 0.8;  // of the moves
  return make_mixture(std::move(kernel), make_mirror_move(coordinate), kNotMirrored);
}

std::unique_ptr<Kernel> make_walk_of(const LogDensity& target) {
  return without_gradient(target, make_random_walk(), usual_refresh(has_jagged(target)));
}

Emulator for_proposals(const Emulator& emulator) {
  return emulator.softened(emulator.is_cubic() ? 0.9 : 0.8);
}

std::unique_ptr<Kernel> make_emulated_kernel(const Emulator& emulator,
                                             const std::vector<Eigen::Index>& informed,
                                             const LogDensity& target, double path_length) {
  return std::make_unique<EmulatedKernel>(
      for_proposals(emulator), informed, target, [&](const EmulatedProposals& proposals) {
        return make_mixture(proposing(proposals, target, path_length), way_out_of(target),
                            has_jagged(target) ? kProposingIfJagged : kProposing);
      });
}

std::unique_ptr<Kernel> make_emulated_kernel(const VettedDensity& target, double path_length) {
  return std::make_unique<EmulatedKernel>(
      target.emulator(), target.informed(), target,
      [&](const EmulatedProposals& proposals) { return proposals.until_taken(path_length); });
}

}  // namespace patina
