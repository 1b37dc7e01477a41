#include "engine/posterior/pilot.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "engine/posterior/least_squares.h"

namespace patina {
namespace {

constexpr std::uint64_t kPilotStream = 0;

/// The columns of the `count` smallest of values.
std::vector<Eigen::Index> smallest(const Eigen::VectorXd& values, Eigen::Index count) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::nth_element(order, order.begin() + count, {}, [&](Eigen::Index i) { return values[i]; });
  order.resize(static_cast<std::size_t>(count));
  return order;
}

/// No further out than the prior's draws.
Eigen::VectorXd within_prior(const Eigen::VectorXd& place) {
  const double furthest = std::sqrt(static_cast<double>(place.size())) + 1;
  return place * std::min(1.0, furthest / std::max(place.norm(), furthest));
}

Eigen::MatrixXd inverse(const Eigen::MatrixXd& covariance) {
  return covariance.llt().solve(Eigen::MatrixXd::Identity(covariance.rows(), covariance.cols()));
}

/// Of a pilot's photos nobody asks for guesses, which take a third of their time.
Simulator without_guess(Simulator simulator) {
  simulator.guess = {};
  return simulator;
}

}  // namespace

Pilot::Pilot(const Simulator& simulator, int photos)
    : photos_(simulate(without_guess(simulator), prior_region(std::ssize(simulator.posterior.informed())),
                       photos, kPilotStream)),
      scores_(photos_.offsets, photos_.summaries,
              Compression(photos_.summaries, simulator.posterior.moments())) {
  const Eigen::MatrixXd errors = photos_.offsets - scores_.left_out();
  precision_ = inverse(errors * errors.transpose() / static_cast<double>(errors.cols()));
}

Region Pilot::region(const Eigen::VectorXd& scores) const {
  const Eigen::Index all = photos_.offsets.cols(), dimension = photos_.offsets.rows();
  const Eigen::Index count = std::min(all, std::max(all / 6, 8 * dimension));
  const Eigen::MatrixXd away = scores_.left_out().colwise() - scores;
  const auto nearest = smallest((away.cwiseProduct(precision_ * away)).colwise().sum(), count);
  Eigen::MatrixXd design(count, 1 + dimension);
  design << Eigen::VectorXd::Ones(count), away(Eigen::all, nearest).transpose();
  const LeastSquares local(design, photos_.offsets(Eigen::all, nearest));
  return region_around(within_prior(local.coefficients.col(0)), local.covariance(), prior_region(dimension));
}

}  // namespace patina
