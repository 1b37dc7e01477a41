#pragma once

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/sampling/posteriordb/model.h"
#include "tests/sampling/posteriordb/terms.h"

namespace patina::posteriordb {

/// low_dim_gauss_mix: two normals with ordered means, y ~ theta N(mu1, sigma1) + (1 - theta) N(mu2, sigma2);
/// (mu1, log(mu2 - mu1), log sigma1, log sigma2, logit theta).
class GaussMix final : public Model {
 public:
  explicit GaussMix(const nlohmann::json& data) : y_(data["y"]) {}

  Eigen::Index dimension() const override { return 5; }

  Evaluation evaluate(const Position& position) const override {
    const Eigen::VectorXd p = parameters(position.continuous);
    const Eigen::VectorXd& u = position.continuous;
    const double log_share[] = {log_logistic(u[4]), log_logistic(-u[4])};
    // theta ~ Beta(5, 5), with the Jacobians of all five maps.
    Evaluation e{
        std::lgamma(10) - 2 * std::lgamma(5) + 5 * (log_share[0] + log_share[1]) + u[1] + u[2] + u[3],
        Eigen::VectorXd::Zero(5)};
    Eigen::Vector4d by_parameter;
    for (int i = 0; i < 4; ++i) {
      const auto prior = normal(p[i], 0, 2);
      e.log_density += prior.value;
      by_parameter[i] = prior.by_x;
    }
    double by_logit = 5 * (1 - 2 * p[4]);
    for (const double y : y_) {
      const NormalTerm part[] = {normal(y, p[0], p[2]), normal(y, p[1], p[3])};
      const double a = log_share[0] + part[0].value, b = log_share[1] + part[1].value, top = std::max(a, b);
      const double total = top + std::log(std::exp(a - top) + std::exp(b - top));
      e.log_density += total;
      const double weight[] = {std::exp(a - total), std::exp(b - total)};
      for (int k = 0; k < 2; ++k) {
        by_parameter[k] -= weight[k] * part[k].by_x;
        by_parameter[2 + k] += weight[k] * part[k].by_scale;
      }
      by_logit += weight[0] * (1 - p[4]) - weight[1] * p[4];
    }
    e.gradient << by_parameter[0] + by_parameter[1], by_parameter[1] * (p[1] - p[0]) + 1,
        by_parameter[2] * p[2] + 1, by_parameter[3] * p[3] + 1, by_logit;
    return e;
  }

  Eigen::VectorXd parameters(const Eigen::VectorXd& u) const override {
    Eigen::VectorXd p(5);
    p << u[0], u[0] + std::exp(u[1]), std::exp(u[2]), std::exp(u[3]), 1 / (1 + std::exp(-u[4]));
    return p;
  }

 private:
  std::vector<double> y_;
};

}  // namespace patina::posteriordb
