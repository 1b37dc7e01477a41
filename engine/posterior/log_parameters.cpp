#include "engine/posterior/log_parameters.h"

#include <algorithm>
#include <cmath>

#include "engine/error.h"
#include "engine/sampling/archive.h"

namespace patina {

LogParameters::LogParameters(const std::vector<TruncatedNormal>& priors)
    : priors_(priors), transforms_(priors.begin(), priors.end()) {}

double LogParameters::offset(std::size_t i) const {
  const TruncatedNormal& prior = priors_[i];
  return (prior.high - prior.low) / 100 - std::min(prior.low, 0.0);
}

Eigen::VectorXd LogParameters::values(const Eigen::VectorXd& u) const {
  Eigen::VectorXd x = u;
  for (std::size_t i = 0; i < priors_.size(); ++i) {
    double& value = x[static_cast<Eigen::Index>(i)];
    value = std::log(transforms_[i].value(value) + offset(i));
  }
  return x;
}

Eigen::VectorXd LogParameters::derivatives(const Eigen::VectorXd& u) const {
  Eigen::VectorXd slopes = Eigen::VectorXd::Ones(u.size());
  for (std::size_t i = 0; i < priors_.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    slopes[k] = transforms_[i].derivative(u[k]) / (transforms_[i].value(u[k]) + offset(i));
  }
  return slopes;
}

void LogParameters::serialise(Archive& archive) {
  Eigen::MatrixXd numbers(4, std::ssize(priors_));
  for (Eigen::Index i = 0; i < numbers.cols(); ++i) {
    const TruncatedNormal& prior = priors_[static_cast<std::size_t>(i)];
    numbers.col(i) << prior.mean, prior.sd, prior.low, prior.high;
  }
  archive(numbers);
  if (!archive.reading()) return;
  if (numbers.rows() != 4) throw ArchiveError("it has priors of another kind");
  std::vector<TruncatedNormal> priors;
  for (const auto prior : numbers.colwise()) priors.push_back({prior[0], prior[1], prior[2], prior[3]});
  try {
    *this = LogParameters(priors);
  } catch (const UserError&) {
    throw ArchiveError("it has a prior that cannot be");
  }
}

}  // namespace patina
