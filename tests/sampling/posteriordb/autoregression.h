#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/sampling/posteriordb/model.h"
#include "tests/sampling/posteriordb/terms.h"

namespace patina::posteriordb {

/// arK: y_t ~ N(alpha + sum_k beta_k y_(t-k), sigma), five lags; (alpha, beta_1 ... beta_5, log sigma).
class Autoregression final : public Model {
 public:
  explicit Autoregression(const nlohmann::json& data) : y_(data["y"]) {}

  Eigen::Index dimension() const override { return kLags + 2; }

  Evaluation evaluate(const Position& position) const override {
    const Eigen::VectorXd& u = position.continuous;
    const double sigma = std::exp(u[kLags + 1]);
    const auto on_sigma = cauchy(sigma, 2.5);
    Evaluation e{u[kLags + 1] + on_sigma.value, Eigen::VectorXd::Zero(dimension())};
    double by_sigma = on_sigma.by_x;
    for (int k = 0; k <= kLags; ++k) {
      const auto prior = normal(u[k], 0, 10);
      e.log_density += prior.value;
      e.gradient[k] += prior.by_x;
    }
    for (std::size_t t = kLags; t < y_.size(); ++t) {
      double mean = u[0];
      for (int k = 1; k <= kLags; ++k) mean += u[k] * y_[t - k];
      const auto seen = normal(y_[t], mean, sigma);
      e.log_density += seen.value;
      e.gradient[0] -= seen.by_x;
      for (int k = 1; k <= kLags; ++k) e.gradient[k] -= seen.by_x * y_[t - k];
      by_sigma += seen.by_scale;
    }
    e.gradient[kLags + 1] = 1 + by_sigma * sigma;
    return e;
  }

  Eigen::VectorXd parameters(const Eigen::VectorXd& u) const override {
    Eigen::VectorXd p = u;
    p[kLags + 1] = std::exp(u[kLags + 1]);
    return p;
  }

 private:
  static constexpr int kLags = 5;
  std::vector<double> y_;
};

}  // namespace patina::posteriordb
