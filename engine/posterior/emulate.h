#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "engine/posterior/emulator.h"
#include "engine/posterior/known_residuals.h"
#include "engine/posterior/posterior.h"
#include "engine/posterior/vetted_density.h"
#include "engine/sampling/chain_state.h"
#include "engine/sampling/metric.h"

namespace patina {

class IrregularityPool;

struct EmulateSettings {
  /// Evaluations of the posterior at most; 0: six for each of the polynomials' monomials, at least 1200. What
  /// is taken of proposals grew no more from three on (leather_6, leather_3, plaster_3, wood_3), to eight or
  /// thirty; but of 600 renders those of leather_6 knew too little of a thin tail that some hundredths of the
  /// posterior lie in.
  int most = 0;
  /// Share of its proposals that the posterior takes: at least this two rounds in a row, and no more are
  /// made; below the other one the emulator is of no use.
  double good = 0.7, poor = 0.1;
  /// How many of the starts, from the first one on, are basins to learn about, each as much as the mode.
  std::size_t basins = 1;
  int threads = 1;
  std::uint64_t seed = 1;

  /// Whose irregularities renders have, each another one's; none: those of the posterior.
  IrregularityPool* others = nullptr;

  std::function<void()> enter_thread = {};  ///< called first on each thread
  std::function<void()> evaluated = {};     ///< called after each evaluation, from any thread; may throw
};

struct Emulation {
  std::optional<Emulator> emulator;  ///< of the informed coordinates; none: too few were taken
  double taken = 0;                  ///< share of the later half of rounds' proposals that the posterior took
  KnownResiduals known;              ///< what it has learnt from
};

constexpr int kEmulatorWalkers = 16;

/// Whether a posterior can be emulated: it has informed coordinates. What its places of textures and its
/// levels do to a log density, the emulator does not know; how much that is, its proposals' acceptance tells.
bool can_emulate(const Posterior& posterior);

/// Whether the emulator is nats off at one of the places that a smooth target likes about as well as its
/// mode: its draws would hardly go there. Of a jagged one it is not asked: there a place may be good by its
/// wrinkle alone, which no polynomial has.
/// @param places  of the target, with their log densities
bool misses_one(const Emulator& emulator, const std::vector<Eigen::Index>& informed, const LogDensity& target,
                const ChainState& mode, const std::vector<ChainState>& places);

/// Learns an emulator from evaluations about the mode, then, round by round, from draws of the emulator, its
/// likelihood softened, and from kEmulatorWalkers chains of the posterior that it proposes for, which also
/// come where it thinks too little of: until they take what it proposes. (With chains that all began at the
/// mode, polynomials of leather_6 never learnt of the lower heights that half of the posterior has.)
/// @param starts   of these chains, in turn: the mode first, then what else the search found, and places that
///                 are spread further than the posterior
/// @param laplace  the covariance that the posterior has about its mode, about
Emulation emulate(const Posterior& posterior, const std::vector<ChainState>& starts, const Metric& laplace,
                  const EmulateSettings& settings);

/// What the posterior is on average over irregularities (VettedDensity): learnt from renders of
/// settings.others about the basins and about the starts, then, round by round, from draws of the emulator
/// that begin at these, its likelihood softened at first, until most of them (EmulateSettings::good) are
/// about as deep as it promises. No chains come along: of one z's they know the pits, not the mean. Where
/// basins lie on both sides of the middle of a coordinate's prior, the emulator has sides.
/// @return none if in the end only few draws are taken (EmulateSettings::poor)
std::optional<AveragedEmulator> emulate_average(const Posterior& posterior,
                                                const std::vector<ChainState>& starts, const Metric& laplace,
                                                const EmulateSettings& settings);

/// An emulator of places that chains have come to, evaluated with other places of textures and levels of
/// their prior: about the posterior it is several times as exact as one that had to find it. Then from
/// its own draws, round by round, until they are where it says: where chains have never been, polynomials
/// promise what is not there (of leather_3's three of four draws lay 10 to 460 nats deeper).
/// @param places  [informed, n], a column each; of many, the last ones are taken
/// @param known   what the emulator has learnt from that chains were proposed to by: it knows tails that they
///                have not been to
Emulator emulate_about(const Posterior& posterior, const Eigen::MatrixXd& places, const KnownResiduals& known,
                       const ChainState& mode, const Metric& laplace, const EmulateSettings& settings);

}  // namespace patina
