#include "engine/diagnostics/effective_sample_size.h"

#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <limits>

namespace patina {
namespace {

double variance(const Eigen::VectorXd& values) {
  return (values.array() - values.mean()).square().sum() / static_cast<double>(values.size() - 1);
}

}  // namespace

Eigen::VectorXd mean_autocovariance(const Eigen::MatrixXd& chains) {
  const Eigen::Index n = chains.rows();
  // Zeros up to twice the length keep the circular correlation from wrapping round.
  const auto padded = static_cast<Eigen::Index>(std::bit_ceil(static_cast<std::size_t>(2 * n)));
  Eigen::FFT<double> fourier;
  Eigen::VectorXd series = Eigen::VectorXd::Zero(padded);
  Eigen::VectorXcd spectrum(padded), power = Eigen::VectorXcd::Zero(padded);
  for (const auto chain : chains.colwise()) {
    series.head(n) = chain.array() - chain.mean();
    fourier.fwd(spectrum, series);
    power += spectrum.cwiseAbs2().cast<std::complex<double>>();
  }
  fourier.inv(series, power);
  return series.head(n) / static_cast<double>(n * chains.cols());
}

double effective_sample_size(const Eigen::MatrixXd& chains) {
  const Eigen::Index n = chains.rows();
  const Eigen::VectorXd covariance = mean_autocovariance(chains);
  const double within = covariance[0] * static_cast<double>(n) / static_cast<double>(n - 1);
  const double between = chains.cols() > 1 ? variance(chains.colwise().mean().transpose()) : 0;
  const double total = covariance[0] + between;
  const auto correlation = [&](Eigen::Index lag) {
    return lag == 0 ? 1 : 1 - (within - covariance[lag]) / total;
  };

  // Pairs of lags while their sum is positive, each no larger than the one before; the last lags, of which
  // there are too few products, are left out as in the R package posterior.
  double time = -1, smallest_pair = std::numeric_limits<double>::infinity();
  Eigen::Index lag = 0;
  for (; lag == 0 || lag + 5 < n; lag += 2) {
    const double pair = correlation(lag) + correlation(lag + 1);
    if (!(pair > 0)) break;
    smallest_pair = std::min(smallest_pair, pair);
    time += 2 * smallest_pair;
  }
  if (lag < n) time += std::max(correlation(lag), 0.0);
  const auto size = static_cast<double>(chains.size());
  return size / std::max(time, 1 / std::log10(size));
}

}  // namespace patina
