#pragma once

#include <Eigen/Core>

#include "engine/sampling/chain_state.h"

namespace patina {

/// A trajectory whose energy spans more than this (in nats) has left the path it should follow (Stan's
/// limit).
constexpr double kDivergentEnergy = 1000;

/// A point of phase space. The momentum is whitened: with the metric C = L L^T standing for the inverse mass
/// matrix, momentum = L^T p ~ N(0, I), so that no kernel needs C^-1, and an inner product of whitened momenta
/// is that of a momentum and a velocity, p . C q.
struct PhasePoint {
  ChainState state;
  Eigen::VectorXd momentum;
  Eigen::VectorXd pull = {};  ///< L^T gradient; empty: not known yet. leapfrog() leaves it for the next step
};

/// The Hamiltonian: -log density + |momentum|^2 / 2; +infinity where there is no density.
double energy(const PhasePoint& point);

/// One leapfrog step (Stoermer-Verlet) of the given length, negative to go back in time: reversible, volume
/// preserving, of second order. Makes one evaluation. All steps from a point are in one metric. Should the
/// target throw, `point` is lost but nothing else.
void leapfrog(const LogDensity& target, const Metric& metric, double step, PhasePoint& point);

}  // namespace patina
