#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/diagnostics/convergence.h"

// Vectors computed by ArviZ and published with Stan; the file tells which.

namespace patina {
namespace {

using Diagnostic = std::function<double(ChainDraws)>;

const std::map<std::string, Diagnostic>& diagnostics() {
  static const std::map<std::string, Diagnostic> table{
      {"mean", [](ChainDraws x) { return x.mean(); }},
      {"rhat_rank", split_rhat},
      {"ess_mean", mean_ess},
      {"ess_bulk", bulk_ess},
      {"ess_tail", tail_ess},
      {"mcse_mean", mcse_mean},
      {"mcse_sd_posterior_R", mcse_sd},
      {"mcse_q5", [](ChainDraws x) { return mcse_quantile(x, 0.05); }},
      {"mcse_q50", [](ChainDraws x) { return mcse_quantile(x, 0.5); }},
      {"mcse_q95", [](ChainDraws x) { return mcse_quantile(x, 0.95); }},
      {"median", [](ChainDraws x) { return quantile(x, 0.5); }},
  };
  return table;
}

Eigen::MatrixXd draws_of(const nlohmann::json& chains) {
  Eigen::MatrixXd draws(chains[0].size(), chains.size());
  for (std::size_t k = 0; k < chains.size(); ++k)
    for (std::size_t t = 0; t < chains[k].size(); ++t) draws(t, k) = chains[k][t];
  return draws;
}

class DiagnosticsReference : public testing::Test {
 protected:
  void SetUp() override {
    const std::filesystem::path file =
        std::filesystem::path(PATINA_SHARED_DIR) / "reference/diagnostics_vectors.json";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "no reference vectors at " << file;
    vectors_ = nlohmann::json::parse(std::ifstream(file));
  }

  nlohmann::json vectors_;
};

TEST_F(DiagnosticsReference, agrees_with_arviz_and_posterior_to_ten_digits) {
  int compared = 0;
  for (const auto& [name, vector] : vectors_.items()) {
    if (!vector.contains("expected")) continue;
    const Eigen::MatrixXd draws = draws_of(vector["draws"]);
    for (const auto& [key, diagnostic] : diagnostics()) {
      if (!vector["expected"].contains(key)) continue;
      const double expected = vector["expected"][key];
      EXPECT_NEAR(diagnostic(draws), expected, 1e-10 * std::abs(expected)) << name << ", " << key;
      ++compared;
    }
  }
  EXPECT_GE(compared, 30);
}

TEST_F(DiagnosticsReference, agrees_with_the_constants_in_stans_own_tests) {
  int compared = 0;
  for (const auto& [name, vector] : vectors_.items()) {
    if (!vector.contains("expected_in_stan_tests")) continue;
    const Eigen::MatrixXd draws = draws_of(vector["draws"]);
    for (const auto& [key, expected] : vector["expected_in_stan_tests"].items()) {
      if (!diagnostics().contains(key)) continue;
      EXPECT_NEAR(diagnostics().at(key)(draws), expected.get<double>(), 1e-4) << name << ", " << key;
      ++compared;
    }
  }
  EXPECT_GE(compared, 6);
}

}  // namespace
}  // namespace patina
