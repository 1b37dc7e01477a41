#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/similar_media.h"

namespace patina {
namespace {

constexpr int kPhotoResolution = 32;
constexpr Scatterer kTruth = kScatterers[1];

struct Moments {
  double mean = 0, sd = 0;
};

/// @param value, weight  one each per point; weights need not sum to 1
Moments moments(const std::vector<double>& value, const std::vector<double>& weight) {
  double total = 0, sum = 0, squares = 0;
  for (std::size_t i = 0; i < value.size(); ++i) {
    total += weight[i];
    sum += weight[i] * value[i];
    squares += weight[i] * value[i] * value[i];
  }
  const double mean = sum / total;
  return {mean, std::sqrt(squares / total - mean * mean)};
}

/// What is asked of a posterior: how far its points lie from the curve, in logarithms, and where along it.
struct Ridge {
  Moments across;  ///< of log((1 - g) sigma_s / the truth's)
  Moments along;   ///< of g
};

Ridge ridge(const std::vector<Scatterer>& points, const std::vector<double>& weight) {
  std::vector<double> across, along;
  for (const Scatterer& point : points) {
    across.push_back(std::log(point.reduced() / kTruth.reduced()));
    along.push_back(point.g);
  }
  return {moments(across, weight), moments(along, weight)};
}

Ridge ridge_of_draws(const std::vector<Scatterer>& draws) {
  return ridge(draws, std::vector<double>(draws.size(), 1));
}

/// The same by the rule of rectangles over the sampling coordinates, in which the prior is N(0, I).
Ridge ridge_by_quadrature(const Posterior& posterior) {
  constexpr double kReach = 3, kStep = 0.125;
  std::vector<Scatterer> points;
  std::vector<double> logs;
  for (double x = -kReach; x <= kReach; x += kStep)
    for (double y = -kReach; y <= kReach; y += kStep) {
      const Position position{Eigen::Vector2d(x, y), {}};
      points.push_back(scatterer_at(posterior, position));
      logs.push_back(posterior.evaluate(position).log_density);
    }
  const double highest = *std::ranges::max_element(logs);
  for (double& weight : logs) weight = std::exp(weight - highest);
  return ridge(points, logs);
}

TEST(Similarity, DrawsLieAlongTheCurveOfSimilarMediaAndNotAtOnePlaceOfIt) {
  const Posterior posterior = posterior_of(kTruth, kPhotoResolution);
  const std::vector<Scatterer> draws =
      draw_scatterers(posterior, {.chains = 4, .warmup = 300, .draws = 1000});
  const Ridge drawn = ridge_of_draws(draws);
  EXPECT_NEAR(drawn.across.mean, 0, 0.1);
  EXPECT_LT(drawn.across.sd, 0.2);
  EXPECT_GT(drawn.along.sd, 0.2);

  // That the one hangs on the other is no accident of their marginals: pairs of different draws are
  // elsewhere.
  std::vector<Scatterer> shuffled = draws;
  for (std::size_t i = 0; i < draws.size(); ++i)
    shuffled[i].g = draws[(i + draws.size() / 3) % draws.size()].g;
  EXPECT_GT(ridge_of_draws(shuffled).across.sd, 2.5 * drawn.across.sd);

  const Ridge exact = ridge_by_quadrature(posterior);
  EXPECT_NEAR(drawn.across.mean, exact.across.mean, 0.05);
  EXPECT_NEAR(drawn.across.sd, exact.across.sd, 0.05);
  EXPECT_NEAR(drawn.along.mean, exact.along.mean, 0.1);
  EXPECT_NEAR(drawn.along.sd, exact.along.sd, 0.07);
}

}  // namespace
}  // namespace patina
