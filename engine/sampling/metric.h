#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace patina {

/// What of a covariance a metric keeps: nothing, the variances, or all of it; or all of it in coordinates
/// that a Straightening has straightened first.
enum class MetricKind { identity, diagonal, dense, curved };

std::vector<std::string> metric_names();

/// @throws std::invalid_argument for a name that is not among metric_names()
MetricKind metric_kind(const std::string& name);

/// The part of a covariance that a metric of that kind keeps.
Eigen::MatrixXd restricted(const Eigen::MatrixXd& covariance, MetricKind kind);

/// An estimate of the posterior covariance C = L L^T that preconditions the kernels.
class Metric {
 public:
  /// @throws std::invalid_argument unless covariance is square, symmetric and positive definite
  explicit Metric(const Eigen::MatrixXd& covariance);
  static Metric identity(Eigen::Index dimension);

  Eigen::Index dimension() const { return covariance_.rows(); }
  const Eigen::MatrixXd& covariance() const { return covariance_; }

  Eigen::VectorXd multiply(const Eigen::VectorXd& v) const { return covariance_ * v; }  ///< C v
  Eigen::VectorXd colour(const Eigen::VectorXd& v) const;             ///< L v: white noise to N(0, C)
  Eigen::VectorXd colour_transposed(const Eigen::VectorXd& v) const;  ///< L^T v
  double inverse_norm2(const Eigen::VectorXd& v) const;               ///< v^T C^-1 v

  /// The standard deviation of each coordinate while all others are held.
  const Eigen::VectorXd& conditional_sds() const { return conditional_sds_; }

  /// The metric of some coordinates while the others are held: the inverse of their block of C^-1. The last
  /// one that was asked for is kept, since kernels ask in every transition. Safe for several threads at a
  /// time.
  std::shared_ptr<const Metric> conditional(const std::vector<Eigen::Index>& coordinates) const;

 private:
  struct LastBlock {
    std::mutex mutex;
    std::vector<Eigen::Index> coordinates;
    std::shared_ptr<const Metric> metric;
  };

  Eigen::MatrixXd precision() const;

  Eigen::MatrixXd covariance_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::VectorXd conditional_sds_;
  std::shared_ptr<LastBlock> last_block_ = std::make_shared<LastBlock>();  ///< copies may share it
};

}  // namespace patina
