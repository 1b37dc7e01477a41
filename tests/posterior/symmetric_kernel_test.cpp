#include "engine/posterior/symmetric_kernel.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include <limits>

#include "engine/sampling/rng.h"

namespace patina {
namespace {

TEST(SymmetricProduct, IsThatOfTheWholeMatrixThoughTheLowerTriangleAloneIsRead) {
  Rng rng(3);
  for (const Eigen::Index size : {1, 2, 3, 4, 5, 7, 8, 11, 12, 13, 31, 64, 250}) {
    Eigen::MatrixXd lower(size, size);
    for (auto column : lower.colwise()) column = rng.normals(size);
    const Eigen::VectorXd x = rng.normals(size);
    const Eigen::VectorXd expected = Eigen::MatrixXd(lower.selfadjointView<Eigen::Lower>()) * x;
    lower.triangularView<Eigen::StrictlyUpper>().setConstant(std::numeric_limits<double>::quiet_NaN());
    Eigen::VectorXd product(size);
    symmetric::multiply(lower.data(), x.data(), product.data(), size);
    EXPECT_TRUE(product.isApprox(expected, 1e-13)) << size;
  }
}

}  // namespace
}  // namespace patina
