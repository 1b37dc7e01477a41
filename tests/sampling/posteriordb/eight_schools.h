#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/sampling/posteriordb/model.h"
#include "tests/sampling/posteriordb/terms.h"

namespace patina::posteriordb {

/// theta_j ~ N(mu, tau), y_j ~ N(theta_j, sigma_j), mu ~ N(0, 5), tau ~ Cauchy(0, 5).
/// Centred: (theta_1 ... theta_8, mu, log tau); otherwise with (theta_j - mu) / tau in place of theta_j.
class EightSchools final : public Model {
 public:
  EightSchools(const nlohmann::json& data, bool centred)
      : y_(data["y"]), sigma_(data["sigma"]), centred_(centred) {}

  Eigen::Index dimension() const override { return 10; }

  Evaluation evaluate(const Position& position) const override {
    const Eigen::VectorXd& u = position.continuous;
    const double mu = u[8], tau = std::exp(u[9]);
    Evaluation e{u[9], Eigen::VectorXd::Unit(10, 9)};
    const auto on_mu = normal(mu, 0, 5);
    const auto on_tau = cauchy(tau, 5);
    e.log_density += on_mu.value + on_tau.value;
    e.gradient[8] += on_mu.by_x;
    e.gradient[9] += on_tau.by_x * tau;
    for (int j = 0; j < 8; ++j) {
      const double theta = centred_ ? u[j] : mu + tau * u[j];
      const auto school = centred_ ? normal(theta, mu, tau) : normal(u[j], 0, 1);
      const auto seen = normal(y_[j], theta, sigma_[j]);
      e.log_density += school.value + seen.value;
      e.gradient[j] += school.by_x - seen.by_x * (centred_ ? 1 : tau);
      e.gradient[8] -= centred_ ? school.by_x : seen.by_x;
      e.gradient[9] += centred_ ? school.by_scale * tau : -seen.by_x * tau * u[j];
    }
    return e;
  }

  Eigen::VectorXd parameters(const Eigen::VectorXd& u) const override {
    Eigen::VectorXd p = u;
    p[9] = std::exp(u[9]);
    if (!centred_) p.head(8) = (u[8] + p[9] * u.head(8).array()).matrix();
    return p;
  }

 private:
  std::vector<double> y_, sigma_;
  bool centred_;
};

}  // namespace patina::posteriordb
