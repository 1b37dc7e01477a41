#include "engine/posterior/log_parameters.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "engine/error.h"
#include "engine/sampling/archive.h"

namespace patina {

LogParameters::LogParameters(const std::vector<TruncatedNormal>& priors)
    : LogParameters(priors, std::vector<bool>(priors.size(), true)) {}

LogParameters::LogParameters(const std::vector<TruncatedNormal>& priors, std::vector<bool> taken)
    : priors_(priors), taken_(std::move(taken)), transforms_(priors.begin(), priors.end()) {
  assert(taken_.size() == priors_.size());
}

double LogParameters::offset(std::size_t i) const {
  const TruncatedNormal& prior = priors_[i];
  return (prior.high - prior.low) / 100 - std::min(prior.low, 0.0);
}

Eigen::VectorXd LogParameters::values(const Eigen::VectorXd& u) const {
  Eigen::VectorXd x = u;
  for (std::size_t i = 0; i < priors_.size(); ++i) {
    if (!taken_[i]) continue;
    double& value = x[static_cast<Eigen::Index>(i)];
    value = std::log(transforms_[i].value(value) + offset(i));
  }
  return x;
}

Eigen::VectorXd LogParameters::derivatives(const Eigen::VectorXd& u) const {
  Eigen::VectorXd slopes = Eigen::VectorXd::Ones(u.size());
  for (std::size_t i = 0; i < priors_.size(); ++i) {
    if (!taken_[i]) continue;
    const auto k = static_cast<Eigen::Index>(i);
    slopes[k] = transforms_[i].derivative(u[k]) / (transforms_[i].value(u[k]) + offset(i));
  }
  return slopes;
}

void LogParameters::serialise(Archive& archive) {
  Eigen::MatrixXd numbers(5, std::ssize(priors_));
  for (Eigen::Index i = 0; i < numbers.cols(); ++i) {
    const TruncatedNormal& prior = priors_[static_cast<std::size_t>(i)];
    const double taken = taken_[static_cast<std::size_t>(i)] ? 1 : 0;
    numbers.col(i) << prior.mean, prior.sd, prior.low, prior.high, taken;
  }
  archive(numbers);
  if (!archive.reading()) return;
  if (numbers.rows() != 5) throw ArchiveError("it has priors of another kind");
  std::vector<TruncatedNormal> priors;
  std::vector<bool> taken;
  for (const auto column : numbers.colwise()) {
    priors.push_back({column[0], column[1], column[2], column[3]});
    taken.push_back(column[4] != 0);
  }
  try {
    *this = LogParameters(priors, taken);
  } catch (const UserError&) {
    throw ArchiveError("it has a prior that cannot be");
  }
}

}  // namespace patina
