#include "engine/run/openblas.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <Eigen/Core>

#include <string>

#include "engine/sampling/rng.h"
#include "engine/simd/target.h"

namespace patina {
namespace {

template <class Function>
Function* find(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_DEFAULT, name));
}

TEST(OpenBlas, TakesNoNewProcessorForAnOldOne) {
  prepare_openblas();
  const auto core_name = find<char*()>("openblas_get_corename");
  if (!core_name) GTEST_SKIP() << "another BLAS is in use";
  if (simd::target() == simd::Target::baseline) GTEST_SKIP() << "the processor is old";
  EXPECT_NE(std::string(core_name()), "Prescott");
}

TEST(OpenBlas, MultipliesAsBeforeOnceItIsPrepared) {
  using Dgemm =
      void(const char*, const char*, const int*, const int*, const int*, const double*, const double*,
           const int*, const double*, const int*, const double*, double*, const int*);
  const auto dgemm = find<Dgemm>("dgemm_");
  if (!dgemm) GTEST_SKIP() << "no BLAS is loaded";
  prepare_openblas();
  prepare_openblas();  // as often as one likes
  Rng rng(5);
  const int n = 137;
  Eigen::MatrixXd a(n, n), b(n, n), c = Eigen::MatrixXd::Zero(n, n);
  for (auto column : a.colwise()) column = rng.normals(n);
  for (auto column : b.colwise()) column = rng.normals(n);
  const double one = 1, none = 0;
  dgemm("T", "N", &n, &n, &n, &one, a.data(), &n, b.data(), &n, &none, c.data(), &n);
  EXPECT_TRUE(c.isApprox(a.transpose() * b, 1e-12));
}

}  // namespace
}  // namespace patina
