#include "engine/sampling/map_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tests/sampling/targets.h"

namespace patina {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Two narrow modes far apart, under the prior N(0, I): at level 0 at -1.5 everywhere, at level 1 at `offset`
/// + 1.5 and taller by 5. The second discrete coordinate is worth 2 at level 3.
FunctionDensity two_modes(double offset = 0) {
  return {
      3,
      [=](const Position& position) {
        const Eigen::VectorXd& x = position.continuous;
        const bool tall = position.discrete[0] == 1;
        const Eigen::VectorXd residual = x.array() - (tall ? 1.5 + offset : -1.5);
        const double bonus = 5 * tall + 2 * (position.discrete[1] == 3);
        return Evaluation{bonus - 0.5 * x.squaredNorm() - 50 * residual.squaredNorm(), -x - 100 * residual};
      },
      {2, 4}};
}

TEST(SearchMap, finds_the_taller_of_two_modes_and_the_best_levels) {
  const FunctionDensity target = two_modes();
  for (const int seed : {1, 2, 3, 4, 5}) {
    Rng rng(seed);
    const MapSearchResult found = search_map({&target}, rng);
    EXPECT_EQ(found.best.position.discrete, Eigen::Vector2i(1, 3)) << "seed " << seed;
    // The mode of N(0, 1) times N(1.5, 0.1^2): 1.5 * 100 / 101.
    EXPECT_TRUE(found.best.position.continuous.isApprox(Eigen::VectorXd::Constant(3, 150.0 / 101), 1e-3));
  }
}

/// Correlated, and narrow along the jagged coordinate.
JaggedTarget jagged_target() {
  Eigen::Matrix3d covariance = Eigen::Vector3d(0.02, 0.1, 0.1).asDiagonal();
  covariance(0, 1) = covariance(1, 0) = 0.02;
  return {Eigen::Vector3d(1.2, 0.5, -0.5), covariance};
}

TEST(SearchMap, evolves_along_jagged_coordinates_where_no_gradient_leads) {
  const JaggedTarget target = jagged_target();
  for (const int seed : {1, 2, 3, 4, 5}) {
    Rng rng(seed);
    const OptimizerResult best = search_map({&target}, rng).best;
    // The peak is half a nat high, on a wrinkle: 1 nat below are places some posterior sd / 2 away.
    EXPECT_GT(best.evaluation.log_density, -0.5) << "seed " << seed;
  }
}

/// Another density whose first coordinate is jagged.
class Jagged final : public LogDensity {
 public:
  explicit Jagged(FunctionDensity density) : density_(std::move(density)) {}
  Eigen::Index dimension() const override { return density_.dimension(); }
  std::vector<bool> jagged() const override { return first_alone(dimension()); }
  Evaluation evaluate(const Position& position) const override {
    Evaluation evaluation = density_.evaluate(position);
    evaluation.gradient[0] = 0;
    return evaluation;
  }

 private:
  FunctionDensity density_;
};

TEST(SearchMap, evolves_finalists_where_a_finer_target_says_what_a_coarse_one_cannot) {
  const JaggedTarget fine = jagged_target();
  const Jagged blind(FunctionDensity(3, [](const Position& position) {
    return Evaluation{-0.5 * position.continuous.squaredNorm(), -position.continuous};
  }));
  Rng rng(1);
  EXPECT_GT(search_map({&blind, &fine}, rng).best.evaluation.log_density, -0.5);
}

/// Basins about -1.5 and 1.5 in every coordinate, as high as they are told to be.
Jagged basins(double low, double high) {
  return Jagged(FunctionDensity(3, [=](const Position& position) {
    const double side = position.continuous.sum() < 0 ? -1 : 1;
    const Eigen::VectorXd off = position.continuous.array() - 1.5 * side;
    return Evaluation{(side < 0 ? low : high) - 10 * off.squaredNorm(), -20 * off};
  }));
}

TEST(SearchMap, refines_no_basin_that_is_far_behind_where_both_targets_see) {
  const Jagged fine = basins(5, 0);
  MapSearchSettings settings;
  settings.guesses = {{Eigen::Vector3d::Constant(-1.5), {}}};
  const auto side_found = [&](double behind) {
    const Jagged coarse = basins(-behind, 0);
    Rng rng(4);
    return search_map({&coarse, &fine}, rng, settings).best.position.continuous[0];
  };
  EXPECT_LT(side_found(10), 0) << "the finer target tells these two apart";
  EXPECT_GT(side_found(20), 0);
}

TEST(SearchMap, ends_an_evolution_early_that_gains_nothing) {
  const Jagged coarse = basins(0, 0);
  MapSearchSettings settings;
  settings.evolutions = 1;
  settings.finalists = 1;
  const auto evaluations = [&](double slope) {
    int count = 0;
    const FunctionDensity fine(3, [&](const Position& position) {
      ++count;
      return Evaluation{slope * position.continuous[0], Eigen::Vector3d::Zero()};
    });
    Rng rng(4);
    search_map({&coarse, &fine}, rng, settings);
    return count;
  };
  EXPECT_LT(evaluations(0), 0.4 * evaluations(1));
}

TEST(SearchMap, sweeps_levels_that_no_candidate_had) {
  const FunctionDensity target = two_modes();
  MapSearchSettings settings;
  settings.prior_draws = 0;
  settings.finalists = 1;
  for (const int seed : {1, 2, 3, 4, 5}) {
    Rng rng(seed);
    EXPECT_EQ(search_map({&target}, rng, settings).best.position.discrete[1], 3) << "seed " << seed;
  }
}

/// Its needle is where no draw of the prior comes near enough to climb it.
FunctionDensity needle() {
  return {2, [](const Position& position) {
            const Eigen::VectorXd& x = position.continuous;
            const Eigen::VectorXd apart = x.array() - 4;
            const double height = 40 * std::exp(-50 * apart.squaredNorm());
            return Evaluation{height - 0.5 * x.squaredNorm(), -x - 100 * height * apart};
          }};
}

TEST(SearchMap, looks_where_it_is_told_to_as_well) {
  const FunctionDensity target = needle();
  MapSearchSettings settings;
  Rng without(1), with(1);
  EXPECT_LT(search_map({&target}, without, settings).best.evaluation.log_density, 1);
  settings.guesses = {{Eigen::VectorXd::Constant(2, 3.95), {}}};
  EXPECT_GT(search_map({&target}, with, settings).best.evaluation.log_density, 20);
}

TEST(SearchMap, ends_on_the_finest_target) {
  const FunctionDensity coarse = two_modes(0.2), fine = two_modes(0);
  Rng rng(6);
  const MapSearchResult found = search_map({&coarse, &fine}, rng);
  EXPECT_TRUE(found.best.position.continuous.isApprox(Eigen::VectorXd::Constant(3, 150.0 / 101), 1e-3));
  EXPECT_EQ(found.best.evaluation.log_density, fine.evaluate(found.best.position).log_density);
}

TEST(SearchMap, returns_distinct_basins_best_first) {
  const FunctionDensity target = two_modes();
  Rng rng(7);
  MapSearchSettings settings;
  settings.finalists = 3;
  const MapSearchResult found = search_map({&target}, rng, settings);
  ASSERT_GE(found.basins.size(), 2u);
  EXPECT_EQ(found.best.evaluation.log_density, found.basins.front().evaluation.log_density);
  for (std::size_t i = 1; i < found.basins.size(); ++i) {
    const Position &a = found.basins[i - 1].position, &b = found.basins[i].position;
    EXPECT_GE(found.basins[i - 1].evaluation.log_density, found.basins[i].evaluation.log_density);
    EXPECT_TRUE(a.discrete != b.discrete || (a.continuous - b.continuous).norm() > 0.3);
  }
}

TEST(SearchMap, names_a_basin_once_that_several_finalists_end_in) {
  const FunctionDensity coarse = two_modes();
  const FunctionDensity fine{3,
                             [](const Position& p) {
                               return Evaluation{-0.5 * p.continuous.squaredNorm(), -p.continuous};
                             },
                             {2, 4}};
  Rng rng(7);
  MapSearchSettings settings;
  settings.finalists = 6;
  const auto separate = search_map({&coarse}, rng, settings).basins;
  const auto found = search_map({&coarse, &fine}, rng, settings).basins;
  const auto of_one_level = [](const std::vector<OptimizerResult>& basins) {
    return std::ranges::any_of(basins, [&](const OptimizerResult& a) {
      return std::ranges::any_of(basins, [&](const OptimizerResult& b) {
        return &a != &b && a.position.discrete == b.position.discrete;
      });
    });
  };
  EXPECT_GT(separate.size(), 1u);
  EXPECT_FALSE(of_one_level(found));
}

TEST(SearchMap, is_decided_by_its_seed) {
  const FunctionDensity target = two_modes();
  Rng first(8), second(8);
  EXPECT_EQ(search_map({&target}, first).best.position.continuous,
            search_map({&target}, second).best.position.continuous);
  EXPECT_EQ(first.position(), second.position());
}

TEST(SearchMap, finds_the_same_on_any_number_of_threads) {
  const FunctionDensity coarse = two_modes(0.2), fine = two_modes(0);
  const auto found_by = [&](int threads) {
    MapSearchSettings settings;
    settings.threads = threads;
    Rng rng(8);
    return search_map({&coarse, &fine}, rng, settings);
  };
  const MapSearchResult alone = found_by(1), together = found_by(4);
  EXPECT_EQ(alone.best.position.continuous, together.best.position.continuous);
  ASSERT_EQ(alone.basins.size(), together.basins.size());
  for (std::size_t i = 0; i < alone.basins.size(); ++i)
    EXPECT_EQ(alone.basins[i].evaluation.log_density, together.basins[i].evaluation.log_density);
}

TEST(SearchMap, passes_on_what_a_target_throws_on_any_thread) {
  const FunctionDensity broken{
      2, [](const Position&) -> Evaluation { throw std::runtime_error("no device"); }, {}};
  MapSearchSettings settings;
  settings.threads = 3;
  Rng rng(9);
  EXPECT_THROW(search_map({&broken}, rng, settings), std::runtime_error);
}

TEST(SearchMap, reports_progress_from_nothing_to_all_and_a_best_that_is_where_it_says) {
  const FunctionDensity target = two_modes();
  std::vector<double> fractions;
  MapSearchSettings settings;
  settings.progress = [&](double fraction, const Position& best, double log_density) {
    fractions.push_back(fraction);
    EXPECT_EQ(log_density, target.evaluate(best).log_density);
  };
  Rng rng(9);
  search_map({&target}, rng, settings);
  ASSERT_FALSE(fractions.empty());
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GT(fractions.front(), 0);
  EXPECT_DOUBLE_EQ(fractions.back(), 1);
}

TEST(SearchMap, stops_within_one_iteration_and_still_answers_for_the_finest_target) {
  const FunctionDensity fine = two_modes(), shifted = two_modes(0.2);
  for (const int allowed : {0, 1, 30, 66, 80, 150}) {
    bool stop = allowed == 0;
    int coarse_evaluations = 0, late = 0;
    const FunctionDensity coarse(3,
                                 [&](const Position& position) {
                                   late += stop;
                                   stop = stop || ++coarse_evaluations >= allowed;
                                   return shifted.evaluate(position);
                                 },
                                 {2, 4});
    MapSearchSettings settings;
    settings.stop_requested = [&] { return stop; };
    Rng rng(10);
    const MapSearchResult found = search_map({&coarse, &fine}, rng, settings);
    EXPECT_LE(late, 20) << "allowed " << allowed;  // one line search
    EXPECT_EQ(found.best.evaluation.log_density, fine.evaluate(found.best.position).log_density);
  }
}

TEST(SearchMap, copes_with_candidates_without_density) {
  const FunctionDensity narrow(2, [](const Position& position) {
    const Eigen::VectorXd& x = position.continuous;
    if (x[0] < 0.5) return Evaluation{-kInfinity, Eigen::VectorXd::Zero(2)};
    return Evaluation{-0.5 * x.squaredNorm(), -x};
  });
  Rng rng(11);
  const MapSearchResult found = search_map({&narrow}, rng);
  EXPECT_NEAR(found.best.evaluation.log_density, -0.125, 0.01);
}

TEST(SearchMap, returns_the_priors_mode_where_nothing_has_density) {
  const FunctionDensity nowhere(2,
                                [](const Position&) {
                                  return Evaluation{-kInfinity, Eigen::VectorXd::Zero(2)};
                                },
                                {3});
  Rng rng(12);
  const MapSearchResult found = search_map({&nowhere, &nowhere}, rng);
  EXPECT_EQ(found.best.position.continuous, Eigen::VectorXd::Zero(2));
  EXPECT_EQ(found.best.evaluation.log_density, -kInfinity);
}

TEST(LaplaceCovariance, of_a_gaussian_is_its_covariance) {
  const Eigen::MatrixXd covariance = some_covariance(5);
  const GaussianTarget target(Eigen::VectorXd::Ones(5), covariance);
  EXPECT_TRUE(laplace_covariance(target, {Eigen::VectorXd::Ones(5), {}}).isApprox(covariance, 1e-9));
}

TEST(LaplaceCovariance, is_floored_where_the_density_is_flat_or_curves_up) {
  const FunctionDensity saddle(2, [](const Position& position) {
    const Eigen::VectorXd& x = position.continuous;
    return Evaluation{x[0] * x[0] - 0.5 * x[1] * x[1], Eigen::Vector2d(2 * x[0], -x[1])};
  });
  const Eigen::Matrix2d expected = Eigen::Vector2d(4, 1).asDiagonal();
  EXPECT_TRUE(laplace_covariance(saddle, {Eigen::VectorXd::Zero(2), {}}).isApprox(expected, 1e-9));
}

TEST(LaplaceCovariance, looks_to_one_side_at_the_edge_of_the_support) {
  const FunctionDensity half(1, [](const Position& position) {
    const double x = position.continuous[0];
    if (x < 0) return Evaluation{-kInfinity, Eigen::VectorXd::Zero(1)};
    return Evaluation{-x - 2 * x * x, Eigen::VectorXd::Constant(1, -1 - 4 * x)};
  });
  EXPECT_NEAR(laplace_covariance(half, {Eigen::VectorXd::Zero(1), {}})(0, 0), 0.25, 1e-9);
}

TEST(LaplaceCovariance, measures_jagged_coordinates_over_their_wrinkles) {
  const JaggedTarget target = jagged_target();
  Eigen::Vector3d mode(1.2, 0.5, -0.5);
  const Eigen::MatrixXd found = laplace_covariance(target, {mode, {}});
  Eigen::Matrix3d expected = Eigen::Vector3d(0.02, 0.1, 0.1).asDiagonal();
  expected(0, 1) = expected(1, 0) = 0.02;
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 0.02);
  EXPECT_NEAR(found(0, 0) / 0.02, 1, 0.3);
}

}  // namespace
}  // namespace patina
