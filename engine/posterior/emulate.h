#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "engine/posterior/emulator.h"
#include "engine/posterior/posterior.h"
#include "engine/sampling/kernel.h"
#include "engine/sampling/metric.h"

namespace patina {

struct EmulateSettings {
  int most = 600;  ///< evaluations of the posterior
  /// Standard deviation of the emulator's error, nats, at draws that it has not learnt from, of the prior and
  /// the root of its likelihood: at most this two rounds in a row, and no more are made; above the other one
  /// it is of no use. Draws of the posterior itself lie closer together, and err by half as much.
  double good = 1, poor = 3;
  int threads = 1;
  std::uint64_t seed = 1;
  std::function<void()> enter_thread = {};  ///< called first on each thread
  std::function<void()> evaluated = {};     ///< called after each evaluation, from any thread; may throw
};

struct Emulation {
  std::optional<Emulator> emulator;  ///< none: its error stayed poor
  double error = 0;                  ///< the last one that was measured, nats
  int evaluations = 0;
};

/// Many HMC transitions under the emulator, a little softened, propose, the target, evaluated once, takes or
/// refuses (make_two_stage); and now and then a random walk, which leaves where the emulator thinks too
/// little of a place. @param path_length  as of hmc (kernels.h)
std::unique_ptr<Kernel> make_emulated_kernel(const Emulator& emulator, const LogDensity& target,
                                             double path_length);

/// Whether a posterior can be emulated: polynomials follow no jagged coordinates and no discrete levels.
bool can_emulate(const Posterior& posterior);

/// Whether the emulator is nats off at one of the places that the posterior likes about as well as the mode:
/// its draws would hardly go there. @param places  of the posterior, with their log densities
bool misses_one(const Emulator& emulator, const ChainState& mode, const std::vector<ChainState>& places);

/// Learns an emulator from evaluations about the mode, then from draws of the emulator, its likelihood
/// softened, round by round, until it foretells the next rounds' log densities.
/// @param laplace  the covariance that the posterior has about its mode, about
Emulation emulate(const Posterior& posterior, const Position& mode, const Metric& laplace,
                  const EmulateSettings& settings);

}  // namespace patina
