#include "engine/posterior/error_model.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/full.h>
#include <ATen/ops/ones.h>
#include <gtest/gtest.h>

#include <cmath>

namespace patina {
namespace {

constexpr double kRelative = 0.2, kAbsolute = 0.03;

/// The chi-square of one block whose entries are all wrong by that much.
double chi_square(ErrorScale scale, std::int64_t entries, double photo, double error) {
  const at::Tensor summary = at::full({entries}, photo, at::kDouble);
  const at::Tensor inverse = inverse_sigmas(summary, {{"block", entries, scale}}, kRelative, kAbsolute);
  return (inverse * error).square().sum().item<double>();
}

TEST(ErrorModel, JudgesAGramMatrixByItsRelativeDistanceHoweverManyEntriesItHas) {
  for (const std::int64_t entries : {3, 400})
    EXPECT_NEAR(chi_square(ErrorScale::relative, entries, 7, 0.7), std::pow(0.1 / kRelative, 2), 1e-9);
}

TEST(ErrorModel, CountsOnceWhatTwoBlocksSeeAlike) {
  const at::Tensor summary = at::ones({8}, at::kDouble), off = at::full({8}, 0.3, at::kDouble);
  const auto chi_square_of = [&](const std::vector<SummaryBlock>& blocks, std::int64_t entries) {
    const at::Tensor inverse = inverse_sigmas(summary.narrow(0, 0, entries), blocks, kRelative, kAbsolute);
    return (inverse * off.narrow(0, 0, entries)).square().sum().item<double>();
  };
  const double twice =
      chi_square_of({{"a", 4, ErrorScale::relative, 2}, {"b", 4, ErrorScale::relative, 2}}, 8);
  EXPECT_NEAR(twice, chi_square_of({{"a", 4, ErrorScale::relative}}, 4), 1e-9);
}

TEST(ErrorModel, JudgesASpectrumByItsRelativeErrorAsIfItWereOneGramMatrix) {
  for (const std::int64_t entries : {8, 16})
    EXPECT_NEAR(chi_square(ErrorScale::logarithmic, entries, -5, 0.1), std::pow(0.1 / kRelative, 2), 1e-9);
}

TEST(ErrorModel, FinerRegionsAreNotMoreEvidenceAboutAnErrorThatTheyShare) {
  const double coarse = chi_square(ErrorScale::regional, 12, 0.5, 0.06);
  EXPECT_NEAR(coarse, 12 * std::pow(0.06 / kAbsolute, 2), 1e-9);
  EXPECT_NEAR(chi_square(ErrorScale::regional, 3 * 64, 0.5, 0.06), coarse, 1e-9);
}

TEST(ErrorModel, GivesEachBlockItsOwnSigma) {
  const at::Tensor summary = at::ones({5}, at::kDouble);
  const at::Tensor inverse = inverse_sigmas(
      summary, {{"a", 4, ErrorScale::relative}, {"b", 1, ErrorScale::logarithmic}}, 0.5, kAbsolute);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(inverse[i].item<double>(), 1 / (0.5 * 2), 1e-12);
  EXPECT_NEAR(inverse[4].item<double>(), 2, 1e-12);
}

}  // namespace
}  // namespace patina
