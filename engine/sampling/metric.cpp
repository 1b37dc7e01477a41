#include "engine/sampling/metric.h"

#include <Eigen/LU>

#include <stdexcept>

namespace patina {

std::vector<std::string> metric_names() { return {"identity", "diagonal", "dense", "curved"}; }

MetricKind metric_kind(const std::string& name) {
  if (name == "identity") return MetricKind::identity;
  if (name == "diagonal") return MetricKind::diagonal;
  if (name == "dense") return MetricKind::dense;
  if (name == "curved") return MetricKind::curved;
  throw std::invalid_argument("unknown metric '" + name + "'");
}

Eigen::MatrixXd restricted(const Eigen::MatrixXd& covariance, MetricKind kind) {
  switch (kind) {
    case MetricKind::identity:
      return Eigen::MatrixXd::Identity(covariance.rows(), covariance.cols());
    case MetricKind::diagonal:
      return covariance.diagonal().asDiagonal();
    case MetricKind::dense:
    case MetricKind::curved:
      break;
  }
  return covariance;
}

Metric::Metric(const Eigen::MatrixXd& covariance) : covariance_(covariance) {
  if (covariance.rows() != covariance.cols()) throw std::invalid_argument("a metric must be square");
  if (!covariance.allFinite()) throw std::invalid_argument("a metric must be finite");
  if (!covariance.isApprox(covariance.transpose())) throw std::invalid_argument("a metric must be symmetric");
  factor_.compute(covariance_);
  if (factor_.info() != Eigen::Success) throw std::invalid_argument("a metric must be positive definite");
  conditional_sds_ = precision().diagonal().cwiseSqrt().cwiseInverse();
}

Metric Metric::identity(Eigen::Index dimension) {
  return Metric(Eigen::MatrixXd::Identity(dimension, dimension));
}

Eigen::VectorXd Metric::colour(const Eigen::VectorXd& v) const { return factor_.matrixL() * v; }

Eigen::VectorXd Metric::colour_transposed(const Eigen::VectorXd& v) const {
  return factor_.matrixL().transpose() * v;
}

Eigen::MatrixXd Metric::precision() const {
  return factor_.solve(Eigen::MatrixXd::Identity(dimension(), dimension()));
}

std::shared_ptr<const Metric> Metric::conditional(const std::vector<Eigen::Index>& coordinates) const {
  const std::lock_guard lock(last_block_->mutex);
  if (!last_block_->metric || last_block_->coordinates != coordinates) {
    const Eigen::MatrixXd block = precision()(coordinates, coordinates).inverse();
    last_block_->metric = std::make_shared<const Metric>((block + block.transpose()) / 2);
    last_block_->coordinates = coordinates;
  }
  return last_block_->metric;
}

double Metric::inverse_norm2(const Eigen::VectorXd& v) const {
  return factor_.matrixL().solve(v).squaredNorm();
}

}  // namespace patina
