#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/sampling/kernel.h"

namespace patina {

/// A quarter of the period of a normal posterior in its own metric, at which a path forgets where it began.
constexpr double kPathLength = 1.5;

/// Metropolis-adjusted Langevin (Roberts & Tweedie 1996), preconditioned by the metric.
std::unique_ptr<Kernel> make_mala();

/// Hamiltonian Monte Carlo (Neal 2011) with a path of jittered length: uniform on half to one and a half
/// times path_length, in standard deviations of the metric.
std::unique_ptr<Kernel> make_hmc(double path_length = kPathLength);

/// Proposes a level for every discrete coordinate, uniform over the joint table (paper, Algorithm 1,
/// DiscreteSample).
std::unique_ptr<Kernel> make_discrete_move();

/// Moves one continuous coordinate, chosen at random with jagged ones preferred, towards a fresh draw from
/// N(0, 1): x' = sqrt(1 - b^2) x
/// + b xi with log b uniform on (log 0.1, 0) (preconditioned Crank-Nicolson; Cotter, Roberts, Stuart, White
/// 2013). Where coordinates are scaled to a prior N(0, I) it crosses flat directions, and from one basin to
/// another, in one step, which no local move does. Valid for any target.
std::unique_ptr<Kernel> make_refresh_move();

/// Algorithm 1: with probability alpha the continuous kernel, else the discrete move.
std::unique_ptr<Kernel> make_mixture(std::unique_ptr<Kernel> continuous, std::unique_ptr<Kernel> discrete,
                                     double alpha);

/// A gradient kernel on the coordinates that are not jagged, all others held (Gibbs' way of composing moves),
/// in the metric that is left to them. At least one coordinate must not be jagged.
std::unique_ptr<Kernel> make_smooth_block(std::unique_ptr<Kernel> kernel);

std::vector<std::string> kernel_names();

/// The kernel for a target: the named continuous one, on the smooth coordinates, mixed with refresh moves,
/// and with discrete moves where the target has discrete coordinates.
/// @param alpha    probability of a continuous move (named or refresh) where there are discrete coordinates,
/// (0, 1]
/// @param refresh  probability that a continuous move is a refresh move, [0, 1)
/// @throws std::invalid_argument for an unknown name or a probability out of range
std::unique_ptr<Kernel> make_kernel(const std::string& name, const LogDensity& target, double alpha,
                                    double refresh = 0);

}  // namespace patina
