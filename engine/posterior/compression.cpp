#include "engine/posterior/compression.h"

#include <algorithm>
#include <cmath>

namespace patina {
namespace {

double median_size(const Eigen::VectorXd& entry) {
  std::vector<double> sizes(static_cast<std::size_t>(entry.size()));
  std::ranges::transform(entry, sizes.begin(), [](double s) { return std::abs(s); });
  const auto middle = sizes.begin() + std::ssize(sizes) / 2;
  std::ranges::nth_element(sizes, middle);
  return *middle;
}

}  // namespace

Compression::Compression(const Eigen::MatrixXd& summaries, const std::vector<bool>& moments)
    : scales_(Eigen::VectorXd::Zero(summaries.rows())) {
  constexpr double kShareOfUsual = 0.1;
  for (Eigen::Index i = 0; i < scales_.size(); ++i)
    if (moments[static_cast<std::size_t>(i)]) scales_[i] = kShareOfUsual * median_size(summaries.row(i));
}

Eigen::MatrixXd Compression::operator()(const Eigen::MatrixXd& summaries) const {
  Eigen::MatrixXd compressed = summaries;
  for (Eigen::Index i = 0; i < scales_.size(); ++i)
    if (scales_[i] > 0) compressed.row(i) = (summaries.row(i) / scales_[i]).array().asinh();
  return compressed;
}

}  // namespace patina
