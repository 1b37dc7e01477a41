#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/sampling/rng.h"
#include "tests/sampling/statistics.h"
#include "tests/sampling/targets.h"

namespace patina {

constexpr double kError = 0.3;
inline const Eigen::Vector2d kSeen(1.5, -0.5);

/// Prior N(0, I), seen with a Gaussian error: every tempered density is a Gaussian that is known.
inline FunctionDensity seen_with_an_error() {
  return {2, [](const Position& p) {
            const Eigen::VectorXd& x = p.continuous;
            const Eigen::VectorXd misfit = (x - kSeen) / (kError * kError);
            return Evaluation{-0.5 * x.squaredNorm() - 0.5 * misfit.dot(x - kSeen), -x - misfit};
          }};
}

inline double sd_at(double beta) { return 1 / std::sqrt(1 + beta / (kError * kError)); }
inline double mean_at(double beta, int i) {
  return beta * kSeen[i] / (kError * kError) * sd_at(beta) * sd_at(beta);
}

inline ChainState exact_draw(const LogDensity& target, double beta, Rng& rng) {
  Eigen::VectorXd x(2);
  for (int i = 0; i < 2; ++i) x[i] = mean_at(beta, i) + sd_at(beta) * rng.normal();
  return state_at(target, {x, {}});
}

/// Kolmogorov distance of the worst rung and coordinate from what the ladder says, over what chance allows.
/// @param ends  of each rung its two coordinates: the draws
inline double worst_distance(const std::vector<double>& betas, const std::vector<std::vector<double>>& ends) {
  double worst = 0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const double beta = betas[i / 2];
    const auto cdf = [&](double x) {
      return testing_statistics::normal_cdf((x - mean_at(beta, static_cast<int>(i % 2))) / sd_at(beta));
    };
    worst = std::max(
        worst, testing_statistics::ks_distance(ends[i], cdf) /
                   testing_statistics::dkw_bound(ends[i].size(), 1e-6 / static_cast<double>(ends.size())));
  }
  return worst;
}

}  // namespace patina
