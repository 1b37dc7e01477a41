#pragma once

#include <Eigen/Core>

#include <functional>
#include <vector>

#include "engine/run/draw.h"

namespace patina {

using DrawsByChain = std::vector<std::vector<const Draw*>>;

/// Draws after warm-up by chain, in order.
DrawsByChain by_chain(const std::vector<Draw>& draws);

/// A quantity of every draw, iterations x chains; chains without draws are left out, the others cut to the
/// shortest.
Eigen::MatrixXd matrix_of(DrawsByChain chains, const std::function<double(const Draw&)>& quantity);

/// Sampling coordinates of all draws: one matrix a parameter, iterations x chains.
std::vector<Eigen::MatrixXd> coordinates_of(const DrawsByChain& chains, const ParameterTable& table);

}  // namespace patina
