#include "engine/material/quadrature.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patina {
namespace {

double integral_of_power(const Quadrature& rule, int power) {
  double sum = 0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) sum += rule.weights[i] * std::pow(rule.nodes[i], power);
  return sum;
}

TEST(GaussLegendre, IsExactForPolynomialsOfUpToTwiceAsManyCoefficientsAsNodesAndNoMore) {
  for (const int count : {1, 2, 5, 16}) {
    const Quadrature rule = gauss_legendre(count);
    for (int power = 0; power < 2 * count; ++power)
      EXPECT_NEAR(integral_of_power(rule, power), 1.0 / (power + 1), 1e-13) << count << ", " << power;
  }
  EXPECT_GT(std::abs(integral_of_power(gauss_legendre(2), 4) - 1.0 / 5), 1e-3);
}

}  // namespace
}  // namespace patina
