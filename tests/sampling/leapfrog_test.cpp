#include "engine/sampling/leapfrog.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/sampling/skewed_target.h"
#include "tests/sampling/targets.h"

namespace patina {
namespace {

class Leapfrog : public testing::Test {
 protected:
  PhasePoint exact_point() {
    ChainState state = state_at(target_, SkewedTarget::exact_draw(rng_));
    return {state, rng_.normals(3)};
  }
  PhasePoint after(PhasePoint point, double step_size, int steps) const {
    for (int i = 0; i < steps; ++i) leapfrog(target_, metric_, step_size, point);
    return point;
  }

  SkewedTarget target_;
  Metric metric_{some_covariance(3)};
  Rng rng_{61};
};

TEST_F(Leapfrog, goes_back_the_way_it_came) {
  for (int i = 0; i < 50; ++i) {
    const PhasePoint start = exact_point();
    const PhasePoint back = after(after(start, 0.1, 10), -0.1, 10);
    EXPECT_LT((back.state.position.continuous - start.state.position.continuous).norm(), 1e-9);
    EXPECT_LT((back.momentum - start.momentum).norm(), 1e-9);
  }
}

TEST_F(Leapfrog, errs_in_energy_by_the_square_of_its_step) {
  for (int i = 0; i < 20; ++i) {
    const PhasePoint start = exact_point();
    const auto error = [&](double step, int steps) {
      return std::abs(after(start, step, steps).energy() - start.energy());
    };
    const double coarse = error(0.02, 25), fine = error(0.01, 50);
    if (coarse < 1e-6) continue;  // where the error happens to pass through zero its order does not show
    EXPECT_NEAR(coarse / fine, 4, 1) << "from " << start.state.position.continuous.transpose();
  }
}

/// The determinant of the map's Jacobian by central differences over all six coordinates of phase space.
TEST_F(Leapfrog, keeps_volume) {
  for (int i = 0; i < 10; ++i) {
    const PhasePoint start = exact_point();
    const auto image = [&](int coordinate, double by) {
      PhasePoint point = start;
      if (coordinate < 3) {
        point.state.position.continuous[coordinate] += by;
        point.state.evaluation = target_.evaluate(point.state.position);
      } else {
        point.momentum[coordinate - 3] += by;
      }
      const PhasePoint end = after(point, 0.15, 4);
      Eigen::VectorXd both(6);
      both << end.state.position.continuous, end.momentum;
      return both;
    };
    Eigen::MatrixXd jacobian(6, 6);
    for (int k = 0; k < 6; ++k) jacobian.col(k) = (image(k, 1e-5) - image(k, -1e-5)) / 2e-5;
    EXPECT_NEAR(jacobian.determinant(), 1, 1e-5);
  }
}

// Volume and reversibility at once, over exact draws: the mean of exp(-change of energy) is 1 for any step
// size.
TEST_F(Leapfrog, has_mean_one_of_exp_minus_the_change_of_energy) {
  constexpr int kDraws = 40000;
  double sum = 0, sum_of_squares = 0;
  for (int i = 0; i < kDraws; ++i) {
    const PhasePoint start = exact_point();
    const double ratio = std::exp(start.energy() - after(start, 0.4, 3).energy());
    sum += ratio, sum_of_squares += ratio * ratio;
  }
  const double mean = sum / kDraws;
  const double error = std::sqrt((sum_of_squares / kDraws - mean * mean) / kDraws);
  EXPECT_LT(std::abs(mean - 1), 5 * error);
  EXPECT_LT(error, 0.02);
}

}  // namespace
}  // namespace patina
