#include "engine/sampling/mala.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/sampling/rng.h"
#include "tests/sampling/skewed_target.h"
#include "tests/sampling/statistics.h"

namespace patina {
namespace {

/// log q(from -> to) up to its constant, as the proposal's definition has it.
double log_proposal(const KernelSettings& settings, const ChainState& from, const ChainState& to) {
  const double step2 = settings.step_size * settings.step_size;
  const Eigen::VectorXd mean =
      from.position.continuous + step2 / 2 * settings.metric->multiply(from.evaluation.gradient);
  return -settings.metric->inverse_norm2(to.position.continuous - mean) / (2 * step2);
}

ChainState propose(const SkewedTarget& target, const KernelSettings& settings, const ChainState& from,
                   Rng& rng) {
  const double step = settings.step_size;
  Position position = from.position;
  position.continuous += step * step / 2 * settings.metric->multiply(from.evaluation.gradient) +
                         step * settings.metric->colour(rng.normals(3));
  return state_at(target, position);
}

class MalaRatio : public testing::Test {
 protected:
  SkewedTarget target_;
  KernelSettings settings_ = settings_with(0.6, some_covariance(3));
  Rng rng_{21};
};

TEST_F(MalaRatio, equals_the_ratio_of_the_four_densities) {
  for (int i = 0; i < 100; ++i) {
    const ChainState from = state_at(target_, SkewedTarget::exact_draw(rng_));
    const ChainState to = state_at(target_, SkewedTarget::exact_draw(rng_));
    const double expected = to.evaluation.log_density - from.evaluation.log_density +
                            log_proposal(settings_, to, from) - log_proposal(settings_, from, to);
    EXPECT_NEAR(mala_log_ratio(settings_, from, to), expected, 1e-10 * (1 + std::abs(expected)));
  }
}

TEST_F(MalaRatio, changes_sign_when_start_and_end_change_places) {
  for (int i = 0; i < 100; ++i) {
    const ChainState x = state_at(target_, SkewedTarget::exact_draw(rng_));
    const ChainState y = state_at(target_, SkewedTarget::exact_draw(rng_));
    const double there = mala_log_ratio(settings_, x, y);
    EXPECT_NEAR(there + mala_log_ratio(settings_, y, x), 0, 1e-10 * (1 + std::abs(there)));
  }
}

TEST_F(MalaRatio, has_mean_one_over_exact_draws_and_their_proposals) {
  std::vector<double> ratios, without_reverse_proposal;
  for (int i = 0; i < 100000; ++i) {
    const ChainState from = state_at(target_, SkewedTarget::exact_draw(rng_));
    const ChainState to = propose(target_, settings_, from, rng_);
    ratios.push_back(std::exp(mala_log_ratio(settings_, from, to)));
    without_reverse_proposal.push_back(std::exp(to.evaluation.log_density - from.evaluation.log_density));
  }
  EXPECT_LT(std::abs(testing_statistics::z_score(ratios, 1)), 5);
  EXPECT_GT(std::abs(testing_statistics::z_score(without_reverse_proposal, 1)), 5) << "no power";
}

}  // namespace
}  // namespace patina
