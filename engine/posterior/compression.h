#pragma once

#include <Eigen/Core>

#include <vector>

namespace patina {

/// Makes entries of summaries about linear in what they are made by: second moments, which materials of a
/// prior have over many powers of ten, become nearly logarithms, asinh(s / scale), each with a scale of its
/// own below what is usual.
class Compression {
 public:
  Compression() = default;  ///< leaves all as it is

  /// @param summaries  entries x n, of a region's photos   @param moments  which entries are second moments
  Compression(const Eigen::MatrixXd& summaries, const std::vector<bool>& moments);

  Eigen::MatrixXd operator()(const Eigen::MatrixXd& summaries) const;

 private:
  Eigen::VectorXd scales_;  ///< 0: the entry stays as it is; none: all do
};

}  // namespace patina
