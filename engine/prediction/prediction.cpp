#include "engine/prediction/prediction.h"

#include <cmath>
#include <numbers>

#include "engine/posterior/prior_transform.h"

namespace patina {
namespace {

int drawn_level(const Eigen::VectorXd& probabilities, Rng& rng) {
  double left = rng.uniform();
  const auto last = static_cast<int>(probabilities.size()) - 1;
  for (int level = 0; level < last; ++level)
    if ((left -= probabilities[level]) < 0) return level;
  return last;
}

}  // namespace

ParameterValues Prediction::likeliest() const {
  ParameterValues values{values_at(table, mean), {}};
  for (const Eigen::VectorXd& probabilities : level_probabilities) {
    Eigen::Index level = 0;
    probabilities.maxCoeff(&level);
    values.discrete.push_back(static_cast<int>(level));
  }
  return values;
}

ParameterValues Prediction::draw(Rng& rng) const {
  const Eigen::VectorXd noise =
      precision_factor.transpose().triangularView<Eigen::Upper>().solve(rng.normals(mean.size()));
  ParameterValues values{values_at(table, mean + noise), {}};
  for (const Eigen::VectorXd& probabilities : level_probabilities)
    values.discrete.push_back(drawn_level(probabilities, rng));
  return values;
}

Eigen::VectorXd Prediction::deviations() const {
  const Eigen::MatrixXd inverse = precision_factor.triangularView<Eigen::Lower>().solve(
      Eigen::MatrixXd::Identity(mean.size(), mean.size()));
  return inverse.colwise().norm();
}

double Prediction::log_density(const Eigen::VectorXd& coordinates, const std::vector<int>& levels) const {
  const Eigen::VectorXd whitened = precision_factor.transpose() * (coordinates - mean);
  double log_density = precision_factor.diagonal().array().log().sum() - whitened.squaredNorm() / 2 -
                       static_cast<double>(mean.size()) / 2 * std::log(2 * std::numbers::pi);
  for (std::size_t i = 0; i < levels.size(); ++i) log_density += std::log(level_probabilities[i][levels[i]]);
  return log_density;
}

}  // namespace patina
