#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "engine/sampling/kernels.h"
#include "engine/sampling/leapfrog.h"
#include "tests/sampling/skewed_target.h"

// NUTS against its definition. With the start, the momentum and the directions given, everything but the
// point drawn is decided: the whole trajectory is laid out here at once, every subtree that the doubling
// holds is tested by itself, and the probability of every point is written down.

namespace patina {
namespace {

constexpr int kDeepest = 4, kReach = 1 << kDeepest;
const SkewedTarget kTarget;

/// All points that any sequence of directions could reach; index kReach is the start.
std::vector<PhasePoint> lay_out(const KernelSettings& settings, const PhasePoint& start) {
  std::vector<PhasePoint> points(2 * kReach + 1, start);
  for (int i = 1; i <= kReach; ++i)
    for (const int side : {-1, 1}) {
      PhasePoint& point = points[kReach + side * i];
      point = points[kReach + side * (i - 1)];
      leapfrog(kTarget, *settings.metric, side * settings.step_size, point);
    }
  return points;
}

class Reference {
 public:
  Reference(const KernelSettings& settings, const PhasePoint& start, bool biased)
      : points_(lay_out(settings, start)), biased_(biased), start_energy_(energy(start)) {
    for (int directions = 0; directions < kReach; ++directions) add(directions);
  }

  /// Probability of each index, and the mean number of doublings.
  std::map<int, double> probability;
  double depth = 0;
  const ChainState& at(int index) const { return points_[index].state; }

 private:
  static constexpr double kEach = 1.0 / kReach;

  bool turns(int first, int middle, int last) const {  // [first, middle) and [middle, last]
    const auto sum = [&](int a, int b) {
      Eigen::VectorXd total = Eigen::VectorXd::Zero(3);
      for (int i = a; i <= b; ++i) total += points_[i].momentum;
      return total;
    };
    const auto turned = [&](int a, int b) {
      const Eigen::VectorXd total = sum(a, b);
      return points_[a].momentum.dot(total) <= 0 || points_[b].momentum.dot(total) <= 0;
    };
    return turned(first, last) || turned(first, middle) || turned(middle - 1, last);
  }

  bool holds_a_turn(int first, int size) const {  // in any subtree of a half that is new
    for (int length = 2; length <= size; length *= 2)
      for (int from = first; from < first + size; from += length)
        if (turns(from, from + length / 2, from + length - 1)) return true;
    return false;
  }

  bool diverges(int first, int size) const {
    for (int i = first; i < first + size; ++i)
      if (!(energy(points_[i]) - start_energy_ <= kDivergentEnergy)) return true;
    return false;
  }

  double weight(int first, int size) const {
    double sum = 0;
    for (int i = first; i < first + size; ++i) sum += std::exp(start_energy_ - energy(points_[i]));
    return sum;
  }

  /// Bit k of `directions`: whether doubling k goes forward.
  void add(int directions) {
    int first = kReach, size = 1;
    std::map<int, double> here{{kReach, 1.0}};
    for (int k = 0; k < kDeepest; ++k, size *= 2) {
      const bool forward = directions >> k & 1;
      const int fresh = forward ? first + size : first - size;
      if (diverges(fresh, size) || holds_a_turn(fresh, size)) break;
      depth += kEach;
      const double fresh_weight = weight(fresh, size), old_weight = weight(first, size);
      const double take =
          biased_ ? std::min(1.0, fresh_weight / old_weight) : fresh_weight / (fresh_weight + old_weight);
      for (auto& [index, p] : here) p *= 1 - take;
      for (int i = fresh; i < fresh + size; ++i) here[i] += take * weight(i, 1) / fresh_weight;
      first = std::min(first, fresh);
      if (turns(first, first + size, first + 2 * size - 1)) break;
    }
    for (const auto& [index, p] : here) probability[index] += kEach * p;
  }

  std::vector<PhasePoint> points_;
  bool biased_;
  double start_energy_;
};

/// Sum of (seen - expected) over the root of the sum of the variances: N(0, 1) if the expectations are right.
struct ZScore {
  double sum = 0, variance = 0;
  void add(double seen, double mean, double mean_square) {
    sum += seen - mean;
    variance += mean_square - mean * mean;
  }
  double value() const { return std::abs(sum) / std::sqrt(variance); }
};

using Statistics = std::array<double, 4>;

Statistics statistics(const ChainState& end, const ChainState& start) {
  const Eigen::VectorXd move = end.position.continuous - start.position.continuous;
  return {move[0], move.norm(), end.position.continuous[2], end.evaluation.log_density};
}

/// z of each statistic and of the depth.
std::vector<double> z_scores(double step_size, bool biased) {
  const KernelSettings settings = settings_with(step_size, some_covariance(3));
  const auto nuts = make_nuts(kDeepest);
  std::array<ZScore, 4> z;
  double depth_sum = 0, expected_depth = 0;
  constexpr int kTransitions = 5000;
  Rng rng(81);
  for (int t = 0; t < kTransitions; ++t) {
    const ChainState start = state_at(kTarget, SkewedTarget::exact_draw(rng));
    Rng peek = rng;
    const Reference reference(settings, {start, peek.normals(3)}, biased);
    ChainState end = start;
    depth_sum += nuts->step(kTarget, settings, end, rng).tree_depth;
    expected_depth += reference.depth;
    std::array<double, 4> mean{}, square{};
    bool possible = false;
    for (const auto& [index, p] : reference.probability) {
      const Statistics there = statistics(reference.at(index), start);
      for (int i = 0; i < 4; ++i) mean[i] += p * there[i], square[i] += p * there[i] * there[i];
      possible |= p > 0 && end.position.continuous == reference.at(index).position.continuous;
    }
    EXPECT_TRUE(possible) << "a point that is not on the trajectory, or not within reach";
    const Statistics seen = statistics(end, start);
    for (int i = 0; i < 4; ++i) z[i].add(seen[i], mean[i], square[i]);
  }
  // Depths are within [0, 4], so their variance is 4 at most.
  std::vector<double> scores{std::abs(depth_sum - expected_depth) / std::sqrt(4.0 * kTransitions)};
  for (const ZScore& score : z) scores.push_back(score.value());
  return scores;
}

TEST(Nuts, draws_every_point_with_the_probability_of_its_definition) {
  for (const double step : {0.25, 0.6, 1.1})
    for (const double z : z_scores(step, true)) EXPECT_LT(z, 5) << "step " << step;
}

TEST(Nuts, is_told_from_one_that_is_not_biased_towards_the_new_half) {
  const std::vector<double> z = z_scores(0.6, false);
  EXPECT_GT(*std::ranges::max_element(z), 5);
}

TEST(Nuts, takes_no_more_than_it_may) {
  const GaussianTarget target(Eigen::VectorXd::Zero(2), Eigen::MatrixXd::Identity(2, 2));
  ChainState state = state_at(target, {Eigen::VectorXd::Ones(2), {}});
  Rng rng(82);
  for (int deepest : {1, 3, 6}) {
    const TransitionInfo info =
        make_nuts(deepest)->step(target, settings_with(1e-4, Eigen::MatrixXd::Identity(2, 2)), state, rng);
    EXPECT_EQ(info.tree_depth, deepest);
    EXPECT_EQ(info.evaluations, (1 << deepest) - 1);
  }
}

}  // namespace
}  // namespace patina
