#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "engine/diagnostics/convergence.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/sample.h"

// What a user writes to sample a density of their own, from end to end; it knows nothing of materials.

namespace patina {
namespace {

// What stands between the next two marks is shown in the README, to the letter.
// [readme]
/// Logistic growth of a population, seen at eleven times to 10 %: x = (log rate, log capacity), with prior
/// x ~ N((0, log 100), I).
struct Growth final : LogDensity {
  const std::vector<double> log_seen{0.62, 1.49, 2.23, 3.03, 3.59, 4.10, 4.25, 4.49, 4.44, 4.66, 4.58};

  Eigen::Index dimension() const override { return 2; }

  Evaluation evaluate(const Position& position) const override {
    const Eigen::Vector2d x = position.continuous, offset = x - Eigen::Vector2d(0, std::log(100));
    const double rate = std::exp(x[0]), capacity = std::exp(x[1]);
    Evaluation result{-0.5 * offset.squaredNorm(), -offset};
    for (std::size_t t = 0; t < log_seen.size(); ++t) {
      // log population = log capacity - log(1 + (capacity / 2 - 1) e^(-rate t)), from 2 at t = 0
      const double decay = std::exp(-rate * t), rest = 1 + (capacity / 2 - 1) * decay;
      const double misfit = (log_seen[t] - x[1] + std::log(rest)) / 0.1;
      result.log_density -= 0.5 * misfit * misfit;
      result.gradient[0] += misfit / 0.1 * (capacity / 2 - 1) * decay * rate * t / rest;
      result.gradient[1] += misfit / 0.1 * (1 - capacity / 2 * decay / rest);
    }
    return result;
  }
};

/// @return draws x chains of the log rate and of the log capacity, for split_rhat(), bulk_ess() and the rest
std::vector<Eigen::MatrixXd> draw_growth() {
  const Growth target;
  return sample(target, *make_kernel("nuts", target, 1), {.draws = 1500}).coordinates;
}
// [/readme]

/// The posterior's mean by quadrature on a grid: a second route that needs neither gradient nor chain.
Eigen::Vector2d mean_by_quadrature(const LogDensity& target) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double total = 0;
  for (double x = -1.5; x < 1; x += 0.005)
    for (double y = 3.5; y < 6; y += 0.005) {
      const Eigen::Vector2d point(x, y);
      const double weight = std::exp(target.evaluate({point, {}}).log_density);
      sum += weight * point;
      total += weight;
    }
  return sum / total;
}

TEST(UserDensity, is_sampled_from_end_to_end_and_agrees_with_quadrature) {
  const Growth target;
  const std::vector<Eigen::MatrixXd> draws = draw_growth();
  const Eigen::Vector2d expected = mean_by_quadrature(target);
  for (Eigen::Index i = 0; i < 2; ++i) {
    EXPECT_LT(split_rhat(draws[i]), 1.01);
    EXPECT_GT(bulk_ess(draws[i]), 400);
    EXPECT_GT(tail_ess(draws[i]), 400);
    EXPECT_LT(std::abs(draws[i].mean() - expected[i]), 5 * mcse_mean(draws[i]));
  }
}

TEST(UserDensity, gradient_is_that_of_its_value) {
  const Growth target;
  const Eigen::Vector2d x(-0.2, 4.6);
  const Evaluation at_x = target.evaluate({x, {}});
  for (Eigen::Index i = 0; i < 2; ++i) {
    const Eigen::Vector2d step = 1e-5 * Eigen::Vector2d::Unit(i);
    const double slope =
        (target.evaluate({x + step, {}}).log_density - target.evaluate({x - step, {}}).log_density) / 2e-5;
    EXPECT_NEAR(at_x.gradient[i], slope, 1e-5 * (1 + std::abs(slope)));
  }
}

std::vector<std::string> lines_of(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

TEST(UserDensity, is_the_one_in_the_readme_and_takes_about_thirty_lines) {
  const std::vector<std::string> source = lines_of(PATINA_SOURCE_DIR "/tests/sampling/user_density_test.cpp"),
                                 readme = lines_of(PATINA_SOURCE_DIR "/README.md");
  const auto begin = std::ranges::find(source, "// [readme]") + 1,
             end = std::ranges::find(source, "// [/readme]");
  ASSERT_LT(begin, end);
  EXPECT_LE(end - begin, 35);
  std::vector<std::string> shown;  // a code block of Markdown is indented by four spaces
  for (auto line = begin; line != end; ++line) shown.push_back(line->empty() ? "" : "    " + *line);
  EXPECT_NE(std::ranges::search(readme, shown).begin(), readme.end());
}

}  // namespace
}  // namespace patina
