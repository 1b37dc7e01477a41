#include "engine/posterior/log_parameters.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/error.h"
#include "engine/sampling/archive.h"

namespace patina {

LogParameters::LogParameters(const std::vector<TruncatedNormal>& priors, const Eigen::VectorXd& scales)
    : priors_(priors), transforms_(priors.begin(), priors.end()), scales_(scales) {
  assert(scales.size() == std::ssize(priors) && (scales.array() > 0).all());
}

LogParameters LogParameters::about(const std::vector<TruncatedNormal>& priors, const Eigen::VectorXd& place,
                                   const Eigen::VectorXd& sds) {
  constexpr double kShare = 0.1;
  Eigen::VectorXd scales(place.size());
  for (std::size_t i = 0; i < priors.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double above = PriorTransform(priors[i]).value(place[k] + sds[k]) - std::min(priors[i].low, 0.0);
    const double least = 1e-4 * (priors[i].high - priors[i].low);
    scales[k] = std::max(kShare * above, least);
  }
  return {priors, scales};
}

double LogParameters::offset(std::size_t i) const {
  return scales_[static_cast<Eigen::Index>(i)] - std::min(priors_[i].low, 0.0);
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

bool LogParameters::fits(Eigen::Index dimension) const {
  return priors_.empty() || std::ssize(priors_) == dimension;
}

void LogParameters::serialise(Archive& archive) {
  Eigen::MatrixXd numbers(5, std::ssize(priors_));
  for (Eigen::Index i = 0; i < numbers.cols(); ++i) {
    const TruncatedNormal& prior = priors_[static_cast<std::size_t>(i)];
    numbers.col(i) << prior.mean, prior.sd, prior.low, prior.high, scales_[i];
  }
  archive(numbers);
  if (!archive.reading()) return;
  if (numbers.rows() != 5) throw ArchiveError("it has priors of another kind");
  if (!numbers.row(4).allFinite() || !(numbers.row(4).array() > 0).all())
    throw ArchiveError("it has a scale that cannot be");
  std::vector<TruncatedNormal> priors;
  for (const auto prior : numbers.colwise()) priors.push_back({prior[0], prior[1], prior[2], prior[3]});
  try {
    *this = LogParameters(priors, numbers.row(4).transpose());
  } catch (const UserError&) {
    throw ArchiveError("it has a prior that cannot be");
  }
}

}  // namespace patina
