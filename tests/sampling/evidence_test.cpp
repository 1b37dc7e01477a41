#include "engine/sampling/evidence.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "engine/sampling/kernels.h"
#include "engine/sampling/map_search.h"
#include "engine/sampling/sequential.h"
#include "tests/sampling/statistics.h"
#include "tests/sampling/targets.h"

// Evidences that are known: the mean of exp(log density + |x|^2 / 2) over N(0, I) and the levels.

namespace patina {
namespace {

/// A target, and the logarithm of its evidence.
struct Known {
  FunctionDensity target;
  double log_evidence;
};

/// Likelihood exp(-(x - seen)' P (x - seen) / 2): what is left of an N(seen; 0, I + P^-1) in d dimensions.
Known gaussian(Eigen::Index d) {
  const Eigen::MatrixXd covariance = 0.3 * some_covariance(d), precision = covariance.inverse();
  Eigen::VectorXd seen(d);
  for (Eigen::Index i = 0; i < d; ++i) seen[i] = std::cos(2.0 * i);
  const Eigen::MatrixXd predictive = covariance + Eigen::MatrixXd::Identity(d, d);
  const double log_evidence = 0.5 * std::log(covariance.determinant() / predictive.determinant()) -
                              0.5 * seen.dot(predictive.inverse() * seen);
  return {{d,
           [precision, seen](const Position& p) {
             const Eigen::VectorXd& x = p.continuous;
             const Eigen::VectorXd pull = precision * (x - seen);
             return Evaluation{-0.5 * x.squaredNorm() - 0.5 * pull.dot(x - seen), -x - pull};
           }},
          log_evidence};
}

/// In each of 16 coordinates exp(-(x - m)^2 / (2 s^2)) above a bound and nothing below, m from above the
/// bound to below it: a normal integral's tail.
Known truncated_gaussian() {
  constexpr int d = 16;
  constexpr double s = 0.3, bound = -1.2;
  const auto m = [](int i) { return -1.5 + 0.1 * i; };
  double log_evidence = 0;
  for (int i = 0; i < d; ++i) {
    const double v = s * s / (1 + s * s), centre = m(i) / (1 + s * s);
    log_evidence += 0.5 * std::log(v) - 0.5 * m(i) * m(i) / (1 + s * s) +
                    std::log(testing_statistics::normal_cdf((centre - bound) / std::sqrt(v)));
  }
  return {{d,
           [m](const Position& p) {
             const Eigen::VectorXd& x = p.continuous;
             if (x.minCoeff() < bound)
               return Evaluation{-std::numeric_limits<double>::infinity(), Eigen::VectorXd::Zero(d)};
             Evaluation evaluation{-0.5 * x.squaredNorm(), -x};
             for (int i = 0; i < d; ++i) {
               evaluation.log_density -= 0.5 * (x[i] - m(i)) * (x[i] - m(i)) / (s * s);
               evaluation.gradient[i] -= (x[i] - m(i)) / (s * s);
             }
             return evaluation;
           }},
          log_evidence};
}

/// A choice among 3 x 2 places, each seen with the error 0.2: a mean of six Gaussian evidences.
Known with_levels() {
  const double s2 = 0.04;
  const auto place = [](int i, int j) { return Eigen::Vector2d(1.2 * i - 1, 0.7 * j); };
  double evidence = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 2; ++j)
      evidence += s2 / (1 + s2) * std::exp(-0.5 * place(i, j).squaredNorm() / (1 + s2)) / 6;
  return {{2,
           [place, s2](const Position& p) {
             const Eigen::Vector2d x = p.continuous, offset = x - place(p.discrete[0], p.discrete[1]);
             return Evaluation{-0.5 * (x.squaredNorm() + offset.squaredNorm() / s2), -x - offset / s2};
           },
           {3, 2}},
          std::log(evidence)};
}

SequentialSettings quick(std::uint64_t seed) { return {.islands = 4, .particles = 128, .seed = seed}; }

LogEvidence sequential(const FunctionDensity& target, const std::string& kernel, std::uint64_t seed) {
  return sample_sequentially(target, *make_kernel(kernel, target, 0.7, 0.25), quick(seed)).evidence;
}

void expect_close(const LogEvidence& found, double exact, double largest_error, const std::string& what) {
  EXPECT_LT(std::abs(found.value - exact), 3 * found.error)
      << what << ": " << found.value << ", not " << exact;
  EXPECT_LT(found.error, largest_error) << what;
}

TEST(Laplace, is_exact_for_a_gaussian_likelihood) {
  for (const Eigen::Index d : {1, 3, 8}) {
    const auto [target, exact] = gaussian(d);
    const OptimizerResult top = maximize(target, {Eigen::VectorXd::Zero(d), {}});
    const NormalBasin basin{{top.position, top.evaluation}, laplace_covariance(target, top.position)};
    EXPECT_NEAR(laplace_log_evidence({basin}, {}), exact, 1e-3) << d << " dimensions";
  }
}

TEST(Laplace, sums_over_the_levels_whose_basins_it_is_given) {
  const auto [target, exact] = with_levels();
  std::vector<NormalBasin> basins;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 2; ++j) {
      const OptimizerResult top = maximize(target, {Eigen::VectorXd::Zero(2), Eigen::Vector2i(i, j)});
      basins.push_back({{top.position, top.evaluation}, laplace_covariance(target, top.position)});
    }
  EXPECT_NEAR(laplace_log_evidence(basins, target.discrete_levels()), exact, 1e-3);
  basins.pop_back();
  EXPECT_LT(laplace_log_evidence(basins, target.discrete_levels()), exact - 0.05);
}

TEST(SequentialEvidence, of_a_gaussian_likelihood_is_the_closed_form_whatever_the_kernel) {
  const auto [target, exact] = gaussian(4);
  for (const std::string kernel : {"mh", "mala", "hmc"})
    expect_close(sequential(target, kernel, 3), exact, 0.25, kernel);
}

TEST(SequentialEvidence, of_a_gaussian_truncated_in_sixteen_dimensions_is_the_closed_form) {
  const auto [target, exact] = truncated_gaussian();
  SequentialSettings settings = quick(5);
  settings.particles = 256, settings.most_moves = 400;
  const auto kernel = make_kernel("mh", target, 1, 0.25);
  expect_close(sample_sequentially(target, *kernel, settings).evidence, exact, 0.3, "truncated");
}

TEST(SequentialEvidence, of_particles_that_hardly_move_is_too_low_and_they_say_that_they_did_not_forget) {
  const auto [target, exact] = truncated_gaussian();
  SequentialSettings settings = quick(5);
  settings.most_moves = 3;
  const SequentialResult result = sample_sequentially(target, *make_kernel("mh", target, 1, 0.25), settings);
  EXPECT_LT(result.evidence.value, exact - 1);
  EXPECT_GT(result.worst_correlation, 2 * settings.correlation);
}

TEST(SequentialEvidence, sums_over_levels) {
  const auto [target, exact] = with_levels();
  expect_close(sequential(target, "hmc", 7), exact, 0.2, "levels");
}

TEST(SequentialEvidence, has_the_error_that_it_says) {
  const auto [target, exact] = gaussian(3);
  double squares = 0;
  constexpr int kRepeats = 24;
  for (int i = 0; i < kRepeats; ++i) {
    const LogEvidence found = sequential(target, "mala", 100 + i);
    squares += std::pow((found.value - exact) / found.error, 2) / kRepeats;
  }
  // z has Student's t of 3 degrees of freedom about, four islands being few: mean square 3, heavy tails.
  EXPECT_GT(std::sqrt(squares), 0.6);
  EXPECT_LT(std::sqrt(squares), 3.5);
}

TEST(SequentialEvidence, particles_are_draws_of_the_target) {
  const auto [target, exact] = gaussian(3);
  const auto kernel = make_kernel("hmc", target, 1);
  const SequentialResult result = sample_sequentially(target, *kernel, quick(11));
  const Position top = maximize(target, {Eigen::VectorXd::Zero(3), {}}).position;
  const Eigen::MatrixXd covariance = laplace_covariance(target, top);
  for (Eigen::Index i = 0; i < 3; ++i) {
    std::vector<double> sample;
    for (const ChainState& particle : result.particles) sample.push_back(particle.position.continuous[i]);
    const double distance = testing_statistics::ks_distance(sample, [&](double x) {
      return testing_statistics::normal_cdf((x - top.continuous[i]) / std::sqrt(covariance(i, i)));
    });
    // Resampled particles repeat: about a quarter of them count.
    EXPECT_LT(distance, testing_statistics::dkw_bound(sample.size() / 4, 1e-3)) << i;
  }
}

TEST(SequentialEvidence, does_not_depend_on_the_threads) {
  const auto [target, exact] = gaussian(3);
  const auto kernel = make_kernel("hmc", target, 1);
  SequentialSettings one = quick(13), three = one;
  three.threads = 3;
  EXPECT_EQ(sample_sequentially(target, *kernel, one).evidence.value,
            sample_sequentially(target, *kernel, three).evidence.value);
}

TEST(SequentialEvidence, refuses_a_target_without_support) {
  const FunctionDensity nowhere(2, [](const Position&) {
    return Evaluation{-std::numeric_limits<double>::infinity(), Eigen::VectorXd::Zero(2)};
  });
  EXPECT_THROW(sample_sequentially(nowhere, *make_kernel("mh", nowhere, 1), quick(1)), std::invalid_argument);
}

}  // namespace
}  // namespace patina
