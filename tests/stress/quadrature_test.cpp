#include "engine/stress/quadrature.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace patina {
namespace {

TEST(Quadrature, of_a_normal_has_its_mean_and_sd) {
  const Moments m = moments([](double x) { return 1e4 - 0.5 * (x - 1) * (x - 1) / 0.09; }, -8, 8);
  EXPECT_NEAR(m.mean, 1, 1e-9);
  EXPECT_NEAR(m.sd, 0.3, 1e-9);
}

TEST(Quadrature, of_a_jump_at_a_cells_border_is_exact) {
  const Moments m = moments([](double x) { return x < 0 ? std::log(3.0) : 0.0; }, -1, 1);
  EXPECT_NEAR(m.mean, -0.25, 1e-9);
}

TEST(Quadrature, of_a_cut_normal_equals_the_closed_form_at_both_tails) {
  for (const auto& [mean, sd] : {std::pair{0.5, 0.25}, {-1.0, 0.05}, {1.3, 0.1}, {0.2, 5.0}}) {
    const Moments closed = truncated_normal(mean, sd, 0, 1);
    const Moments summed =
        moments([m = mean, s = sd](double t) { return -0.5 * (t - m) * (t - m) / (s * s); }, 0, 1);
    EXPECT_NEAR(closed.mean, summed.mean, 1e-6) << mean;
    EXPECT_NEAR(closed.sd, summed.sd, 1e-6) << mean;
  }
}

}  // namespace
}  // namespace patina
