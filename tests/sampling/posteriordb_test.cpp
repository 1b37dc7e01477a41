#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "engine/diagnostics/convergence.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/sample.h"
#include "tests/sampling/posteriordb/autoregression.h"
#include "tests/sampling/posteriordb/eight_schools.h"
#include "tests/sampling/posteriordb/gauss_mix.h"
#include "tests/sampling/posteriordb/mesquite.h"

// Targets of posteriordb (Magnusson et al. 2024), whose reference draws come from Stan: densities, gradients
// and every reported mean, standard deviation and quantile.

namespace patina::posteriordb {
namespace {

using Json = nlohmann::json;

std::unique_ptr<Model> make_model(const Json& target) {
  const std::string name = target["name"];
  const Json& data = target["data"];
  if (name == "eight_schools_noncentered") return std::make_unique<EightSchools>(data, false);
  if (name == "eight_schools_centered") return std::make_unique<EightSchools>(data, true);
  if (name == "arK") return std::make_unique<Autoregression>(data);
  if (name == "low_dim_gauss_mix") return std::make_unique<GaussMix>(data);
  if (name == "mesquite") return std::make_unique<Mesquite>(data);
  throw std::invalid_argument(name);
}

Eigen::VectorXd vector_of(const Json& json) {
  const std::vector<double> values = json;
  return Eigen::VectorXd::Map(values.data(), static_cast<Eigen::Index>(values.size()));
}

class Posteriordb : public testing::Test {
 protected:
  void SetUp() override {
    const std::filesystem::path file =
        std::filesystem::path(PATINA_SHARED_DIR) / "reference/posteriordb/targets.json";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "no reference targets at " << file;
    const Json all = Json::parse(std::ifstream(file));
    for (const Json& target : all["targets"]) targets_[target["name"]] = target;
    ASSERT_GE(targets_.size(), 5u);
  }

  std::map<std::string, Json> targets_;
};

TEST_F(Posteriordb, densities_and_gradients_are_those_of_the_reference_points) {
  for (const auto& [name, target] : targets_)
    for (const Json& point : target["test_points"]) {
      const Evaluation evaluation = make_model(target)->evaluate({vector_of(point["u"]), {}});
      const double expected = point["logp"];
      EXPECT_NEAR(evaluation.log_density, expected, 1e-10 * std::abs(expected)) << name;
      const Eigen::VectorXd gradient = vector_of(point["grad"]);
      EXPECT_LT((evaluation.gradient - gradient).cwiseAbs().maxCoeff(), 1e-8 * gradient.cwiseAbs().maxCoeff())
          << name;
    }
}

TEST_F(Posteriordb, centred_and_non_centred_schools_are_one_density) {
  const auto centred = make_model(targets_["eight_schools_centered"]);
  const auto other = make_model(targets_["eight_schools_noncentered"]);
  Rng rng(90);
  for (int repeat = 0; repeat < 20; ++repeat) {
    const Eigen::VectorXd u = rng.normals(10);
    Eigen::VectorXd theta = other->parameters(u);
    theta[9] = u[9];
    EXPECT_NEAR(centred->evaluate({theta, {}}).log_density, other->evaluate({u, {}}).log_density - 8 * u[9],
                1e-9);
  }
}

/// Chains from twice the posterior's spread, in a metric of scales that are about right, as a Laplace
/// approximation would give it.
Sample draw(const Json& target, const Kernel& kernel, const SampleSettings& plan) {
  const auto model = make_model(target);
  const Json& reference = target["reference"];
  const Eigen::VectorXd mean = vector_of(reference["unconstrained_mean"]);
  Eigen::MatrixXd scales = Eigen::MatrixXd::Zero(mean.size(), mean.size());
  for (Eigen::Index i = 0; i < mean.size(); ++i) scales(i, i) = reference["unconstrained_cov"][i][i];
  const Metric metric(scales);
  const auto start = [&](Rng& rng) {
    return Position{mean + 2 * metric.colour(rng.normals(mean.size())), {}};
  };
  return sample(*model, kernel, plan, start, metric);
}

/// The chains' parameters instead of their unconstrained coordinates.
std::vector<Eigen::MatrixXd> parameters_of(const Model& model,
                                           const std::vector<Eigen::MatrixXd>& coordinates) {
  std::vector<Eigen::MatrixXd> parameters = coordinates;
  Eigen::VectorXd u(model.dimension());
  for (Eigen::Index k = 0; k < coordinates[0].cols(); ++k)
    for (Eigen::Index t = 0; t < coordinates[0].rows(); ++t) {
      for (Eigen::Index i = 0; i < u.size(); ++i) u[i] = coordinates[i](t, k);
      const Eigen::VectorXd p = model.parameters(u);
      for (Eigen::Index i = 0; i < u.size(); ++i) parameters[i](t, k) = p[i];
    }
  return parameters;
}

/// (ours - reference) / the standard error of the difference, for all that the reference reports.
std::map<std::string, double> z_scores(const Eigen::MatrixXd& x, const Json& reference) {
  const auto z = [&](double ours, double mcse, const std::string& key) {
    return (ours - reference[key].get<double>()) / std::hypot(mcse, reference["mcse_" + key].get<double>());
  };
  const double sd = std::sqrt((x.array() - x.mean()).square().sum() / double(x.size() - 1));
  std::map<std::string, double> scores{{"mean", z(x.mean(), mcse_mean(x), "mean")},
                                       {"sd", z(sd, mcse_sd(x), "sd")}};
  for (const auto& [key, p] : {std::pair{"q5", 0.05}, {"q50", 0.5}, {"q95", 0.95}})
    scores[key] = z(quantile(x, p), mcse_quantile(x, p), key);
  return scores;
}

class PosteriordbKernel : public Posteriordb, public testing::WithParamInterface<std::string> {};

INSTANTIATE_TEST_SUITE_P(Every, PosteriordbKernel, testing::ValuesIn(kernel_names()),
                         [](const auto& info) { return info.param; });

TEST_P(PosteriordbKernel, finds_every_mean_deviation_and_quantile_of_the_reference) {
  for (const char* name : {"eight_schools_noncentered", "arK", "low_dim_gauss_mix", "mesquite"}) {
    const Json& target = targets_[name];
    const auto model = make_model(target);
    const int draws = GetParam() == "mh" ? 30000 : GetParam() == "mala" ? 10000 : 3000;
    const Sample drawn = draw(target, *make_kernel(GetParam(), *model, 1), {.draws = draws});
    const auto parameters = parameters_of(*model, drawn.coordinates);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const Json& reference = target["reference"]["params"][i];
      const std::string what = std::string(name) + ", " + reference["name"].get<std::string>();
      EXPECT_LT(split_rhat(parameters[i]), 1.02) << what;
      EXPECT_GT(bulk_ess(parameters[i]), 1000) << what;
      for (const auto& [key, z] : z_scores(parameters[i], reference))
        EXPECT_LT(std::abs(z), 5) << what << ", " << key;
    }
  }
}

TEST_P(PosteriordbKernel, raises_an_alarm_in_a_funnel) {
  const Json& target = targets_["eight_schools_centered"];
  const auto model = make_model(target);
  const Sample drawn = draw(target, *make_kernel(GetParam(), *model, 1), {.draws = 2000});
  double rhat = 0, fraction = 2;
  for (const Eigen::MatrixXd& x : parameters_of(*model, drawn.coordinates))
    rhat = std::max(rhat, split_rhat(x));
  for (const auto energy : drawn.energy.colwise()) fraction = std::min(fraction, ebfmi(energy));
  // The E-BFMI of a kernel without momenta speaks of its autocorrelation alone.
  const bool kinetic = GetParam() == "hmc" || GetParam() == "nuts";
  EXPECT_TRUE(rhat > 1.01 || drawn.divergences > 0 || (kinetic && fraction < 0.3))
      << "R-hat " << rhat << ", divergences " << drawn.divergences << ", E-BFMI " << fraction;
}

}  // namespace
}  // namespace patina::posteriordb
