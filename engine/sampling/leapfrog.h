#pragma once

#include <Eigen/Core>

#include "engine/sampling/chain_state.h"

namespace patina {

/// A point of phase space. The momentum is kept white: p = L^-T momentum has N(0, C^-1) as its distribution,
/// the kinetic energy is |momentum|^2 / 2, and the metric C = L L^T enters where position and force are
/// moved.
struct PhasePoint {
  ChainState state;
  Eigen::VectorXd momentum;

  /// The Hamiltonian, -log density + |momentum|^2 / 2; +infinity where there is no density.
  double energy() const { return momentum.squaredNorm() / 2 - state.evaluation.log_density; }
};

/// One step of the leapfrog integrator (Neal 2011, equations 5.18 to 5.20), volume-preserving and reversible,
/// for any force that is a function of the position. One evaluation. A negative step size goes back in time.
void leapfrog(const LogDensity& target, const Metric& metric, double step_size, PhasePoint& point);

}  // namespace patina
