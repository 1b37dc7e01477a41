#pragma once

#include <vector>

namespace patina {

/// The integral of f over [0,1] is nearly the sum of weights[i] f(nodes[i]).
struct Quadrature {
  std::vector<double> nodes, weights;
};

/// Exact for polynomials of a degree below 2 count (Golub, Welsch 1969).
Quadrature gauss_legendre(int count);

}  // namespace patina
