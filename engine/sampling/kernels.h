#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/sampling/kernel.h"

namespace patina {

/// Metropolis-adjusted Langevin (Roberts & Tweedie 1996), preconditioned by the metric.
std::unique_ptr<Kernel> make_mala();

/// Proposes a level for every discrete coordinate, uniform over the joint table (paper, Algorithm 1,
/// DiscreteSample).
std::unique_ptr<Kernel> make_discrete_move();

/// Algorithm 1: with probability alpha the continuous kernel, else the discrete move.
std::unique_ptr<Kernel> make_mixture(std::unique_ptr<Kernel> continuous, std::unique_ptr<Kernel> discrete,
                                     double alpha);

std::vector<std::string> kernel_names();

/// The kernel for a target: the named continuous one, mixed with discrete moves where the target has discrete
/// coordinates. @throws std::invalid_argument for an unknown name or alpha outside (0, 1]
std::unique_ptr<Kernel> make_kernel(const std::string& name, const LogDensity& target, double alpha);

}  // namespace patina
