#pragma once

#include <Eigen/Core>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/sampling/posteriordb/model.h"
#include "tests/sampling/posteriordb/terms.h"

namespace patina::posteriordb {

/// weight ~ N(X beta, sigma) with flat priors: a linear regression whose coefficients' scales differ by a
/// thousand; (beta_1 ... beta_7, log sigma).
class Mesquite final : public Model {
 public:
  explicit Mesquite(const nlohmann::json& data)
      : x_(Eigen::MatrixXd::Ones(data["N"], 7)), weight_(Eigen::VectorXd(data["N"].get<int>())) {
    const char* columns[] = {"diam1", "diam2", "canopy_height", "total_height", "density", "group"};
    for (Eigen::Index i = 0; i < weight_.size(); ++i) {
      weight_[i] = data["weight"][i];
      for (int k = 0; k < 6; ++k) x_(i, k + 1) = data[columns[k]][i];
    }
  }

  Eigen::Index dimension() const override { return 8; }

  Evaluation evaluate(const Position& position) const override {
    const Eigen::VectorXd& u = position.continuous;
    const double sigma = std::exp(u[7]);
    const Eigen::VectorXd mean = x_ * u.head(7);
    Evaluation e{u[7], Eigen::VectorXd::Unit(8, 7)};
    for (Eigen::Index i = 0; i < weight_.size(); ++i) {
      const auto seen = normal(weight_[i], mean[i], sigma);
      e.log_density += seen.value;
      e.gradient.head(7) -= seen.by_x * x_.row(i).transpose();
      e.gradient[7] += seen.by_scale * sigma;
    }
    return e;
  }

  Eigen::VectorXd parameters(const Eigen::VectorXd& u) const override {
    Eigen::VectorXd p = u;
    p[7] = std::exp(u[7]);
    return p;
  }

 private:
  Eigen::MatrixXd x_;
  Eigen::VectorXd weight_;
};

}  // namespace patina::posteriordb
