#include "engine/sampling/leapfrog.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "engine/sampling/kernels.h"
#include "tests/sampling/skewed_target.h"
#include "tests/sampling/statistics.h"

namespace patina {
namespace {

const SkewedTarget kTarget;

PhasePoint somewhere(Rng& rng) { return {state_at(kTarget, SkewedTarget::exact_draw(rng)), rng.normals(3)}; }

void follow(const Metric& metric, double step, int steps, PhasePoint& point) {
  for (int i = 0; i < steps; ++i) leapfrog(kTarget, metric, step, point);
}

TEST(Leapfrog, comes_back_when_the_momentum_is_turned_round_or_time_is) {
  const Metric metric(some_covariance(3));
  Rng rng(70);
  for (int repeat = 0; repeat < 50; ++repeat) {
    const PhasePoint start = somewhere(rng);
    PhasePoint turned = start, backward = start;
    follow(metric, 0.2, 20, turned);
    turned.momentum *= -1;
    follow(metric, 0.2, 20, turned);
    follow(metric, 0.2, 20, backward);
    follow(metric, -0.2, 20, backward);
    for (const PhasePoint& end : {turned, backward})
      EXPECT_LT((end.state.position.continuous - start.state.position.continuous).norm(), 1e-11);
    EXPECT_LT((turned.momentum + start.momentum).norm(), 1e-11);
    EXPECT_LT((backward.momentum - start.momentum).norm(), 1e-11);
  }
}

TEST(Leapfrog, is_of_second_order) {
  // The largest energy error over a fixed time: a wrong half step would give 2, a wrong gradient 1.
  const Metric metric(some_covariance(3));
  const auto error = [&](int steps) {
    Rng rng(71);
    std::vector<double> errors;
    for (int repeat = 0; repeat < 40; ++repeat) {
      PhasePoint point = somewhere(rng);
      const double before = energy(point);
      errors.push_back(0);
      for (int i = 0; i < steps; ++i) {
        follow(metric, 1.6 / steps, 1, point);
        errors.back() = std::max(errors.back(), std::abs(energy(point) - before));
      }
    }
    std::ranges::nth_element(errors, errors.begin() + 20);
    return errors[20];
  };
  EXPECT_NEAR(error(40) / error(80), 4, 0.3);
  EXPECT_NEAR(error(80) / error(160), 4, 0.3);
}

TEST(Leapfrog, preserves_volume) {
  const Metric metric(some_covariance(3));
  Rng rng(72);
  const PhasePoint start = somewhere(rng);
  const auto end = [&](const Eigen::VectorXd& from) {
    PhasePoint point{state_at(kTarget, {from.head(3), start.state.position.discrete}), from.tail(3)};
    follow(metric, 0.3, 5, point);
    Eigen::VectorXd to(6);
    to << point.state.position.continuous, point.momentum;
    return to;
  };
  Eigen::VectorXd centre(6);
  centre << start.state.position.continuous, start.momentum;
  Eigen::MatrixXd jacobian(6, 6);
  for (int i = 0; i < 6; ++i) {
    const Eigen::VectorXd h = 1e-5 * Eigen::VectorXd::Unit(6, i);
    jacobian.col(i) = (end(centre + h) - end(centre - h)) / 2e-5;
  }
  EXPECT_NEAR(jacobian.determinant(), 1, 1e-6);
}

/// Mean of exp(-change of the energy) over paths from exact draws, in standard errors from 1.
double volume_z(double final_momentum_scale) {
  const Metric metric(some_covariance(3));
  Rng rng(73);
  std::vector<double> ratios;
  for (int i = 0; i < 60000; ++i) {
    PhasePoint point = somewhere(rng);
    const double before = energy(point);
    follow(metric, 0.7, 3, point);
    point.momentum *= final_momentum_scale;
    ratios.push_back(std::exp(before - energy(point)));
  }
  return testing_statistics::z_score(ratios, 1);
}

TEST(Leapfrog, has_a_mean_acceptance_ratio_of_one_from_exact_draws) {
  EXPECT_LT(std::abs(volume_z(1)), 5);
  EXPECT_GT(std::abs(volume_z(0.97)), 5) << "a map that shrinks momenta by 3 % must be caught";
}

TEST(Hmc, of_one_step_is_mala) {
  const KernelSettings settings = settings_with(0.9, some_covariance(3));
  Rng hmc_rng(74), mala_rng(74);
  ChainState hmc_state = somewhere(hmc_rng).state, mala_state = somewhere(mala_rng).state;
  const auto hmc = make_hmc(1e-3, 24, 0), mala = make_mala();
  for (int t = 0; t < 200; ++t) {
    mala_rng.below(1);  // what HMC takes for its number of steps
    const TransitionInfo a = hmc->step(kTarget, settings, hmc_state, hmc_rng);
    const TransitionInfo b = mala->step(kTarget, settings, mala_state, mala_rng);
    ASSERT_NEAR(a.accept_probability, b.accept_probability, 1e-9);
    ASSERT_LT((hmc_state.position.continuous - mala_state.position.continuous).norm(), 1e-9);
  }
}

TEST(Hmc, takes_paths_of_its_length_on_average_and_never_more_steps_than_it_may) {
  const GaussianTarget target(Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Identity(1, 1));
  const auto mean_steps = [&](double path, int most) {
    Rng rng(75);
    ChainState state = state_at(target, {Eigen::VectorXd::Zero(1), {}});
    double sum = 0;
    for (int t = 0; t < 4000; ++t) {
      const int steps = make_hmc(path, most, 0)
                            ->step(target, settings_with(0.1, Eigen::MatrixXd::Identity(1, 1)), state, rng)
                            .evaluations;
      EXPECT_LE(steps, most);
      EXPECT_GE(steps, 1);
      sum += steps / 4000.0;
    }
    return sum;
  };
  EXPECT_NEAR(mean_steps(1.2, 64), 12, 0.5);
  EXPECT_NEAR(mean_steps(1.2, 9), 5, 0.25);
}

/// The mean over exact draws of x times its successor's: the lag-one autocorrelation.
template <typename Transition>
double autocorrelation(Transition transition) {
  Rng rng(76);
  double sum = 0;
  for (int i = 0; i < 4000; ++i) {
    const double x = rng.normal();
    sum += x * transition(x, rng) / 4000;
  }
  return sum;
}

TEST(Hmc, does_not_walk_in_circles_where_a_fixed_length_would) {
  const GaussianTarget target(Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Identity(1, 1));
  const KernelSettings settings = settings_with(2 * std::numbers::pi / 40, Eigen::MatrixXd::Identity(1, 1));
  const auto start = [&](double x) { return state_at(target, {Eigen::VectorXd::Constant(1, x), {}}); };
  const auto fixed = [&](double x, Rng& rng) {
    PhasePoint point{start(x), rng.normals(1)};
    for (int i = 0; i < 40; ++i) leapfrog(target, *settings.metric, settings.step_size, point);
    return point.state.position.continuous[0];
  };
  const auto kernel = make_hmc(2 * std::numbers::pi, 200);
  const auto jittered = [&](double x, Rng& rng) {
    ChainState state = start(x);
    kernel->step(target, settings, state, rng);
    return state.position.continuous[0];
  };
  EXPECT_GT(autocorrelation(fixed), 0.9);
  EXPECT_LT(std::abs(autocorrelation(jittered)), 0.1);
}

}  // namespace
}  // namespace patina
