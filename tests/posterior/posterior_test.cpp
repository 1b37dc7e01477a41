#include "engine/posterior/posterior.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/error.h"
#include "engine/material/material.h"
#include "engine/material/registry.h"
#include "engine/material/renderer.h"
#include "engine/sampling/rng.h"
#include "engine/summary/summary.h"

namespace patina {
namespace {

constexpr int kResolution = 64;

/// Means of blocks of `side` x `side` pixels.
Image block_means(const Image& image, int side) {
  Image means(image.width / side, image.height / side, 3);
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column)
      for (int c = 0; c < 3; ++c)
        means.at(row / side, column / side, c) += image.at(row, column, c) / static_cast<float>(side * side);
  return means;
}

/// As a sensor sees the middle of the prior, each pixel the mean of `times` x `times` points.
Image sensed(const std::string& material, std::uint64_t z_seed, int resolution, int times) {
  const Renderer renderer(material, z_seed, Capture{});
  return block_means(renderer.render(prior_location(renderer.table()), times * resolution), times);
}

Image synthetic_photo(const std::string& material, std::uint64_t z_seed) {
  return sensed(material, z_seed, kResolution, make_material(material)->oversampling());
}

PosteriorSettings settings_for(const std::string& material) {
  PosteriorSettings settings;
  settings.material = material;
  settings.resolution = kResolution;
  return settings;
}

Position at_prior_draw(const Posterior& posterior, Rng& rng, double spread) {
  Position position;
  position.continuous = spread * rng.normals(posterior.dimension());
  const auto levels = posterior.discrete_levels();
  position.discrete.resize(static_cast<Eigen::Index>(levels.size()));
  for (std::size_t i = 0; i < levels.size(); ++i)
    position.discrete[static_cast<Eigen::Index>(i)] = rng.below(levels[i]);
  return position;
}

class EveryMaterial : public testing::TestWithParam<std::string> {};

/// Whether a central difference agrees with the derivative along a coordinate, by one of a ladder of steps:
/// wide ones straddle kinks, narrow ones drown in the rounding of a float32 render. A wrong derivative fits
/// none.
bool agrees_by_some_step(const Posterior& posterior, const Position& centre, Eigen::Index i,
                         double derivative, double tolerance, double scale) {
  for (const double h : {3e-3, 5e-4, 5e-5}) {
    Position up = centre, down = centre;
    up.continuous[i] += h, down.continuous[i] -= h;
    const double difference = (posterior.value(up).log_density - posterior.value(down).log_density) / (2 * h);
    if (std::abs(difference - derivative) < tolerance * (std::abs(difference) + 0.1 * scale)) return true;
  }
  return false;
}

// The whole chain at once: transform, material, shading, display curve, network, Gram, error model. At a kink
// (a clamp) or where wood's rings are finer than a pixel a coordinate may disagree now and then; a wrong
// gradient disagrees always. Jagged coordinates wrinkle at every scale that float32 resolves, so that for
// them only that is asked here (tests/material has them in double).
TEST_P(EveryMaterial, LogDensityGradientAgreesWithFiniteDifferences) {
  const Posterior posterior(settings_for(GetParam()), synthetic_photo(GetParam(), 2));
  Rng rng(7);
  const std::vector<bool> jagged = posterior.jagged();
  std::vector<int> agreements(static_cast<std::size_t>(posterior.dimension()));
  constexpr int kPoints = 5;
  for (int point = 0; point < kPoints; ++point) {
    const Position centre = at_prior_draw(posterior, rng, 0.7);
    const Evaluation evaluation = posterior.evaluate_with_whole_gradient(centre);
    ASSERT_TRUE(std::isfinite(evaluation.log_density));
    const double scale = 1 + evaluation.gradient.cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < posterior.dimension(); ++i)
      agreements[static_cast<std::size_t>(i)] +=
          agrees_by_some_step(posterior, centre, i, evaluation.gradient[i],
                              jagged[static_cast<std::size_t>(i)] ? 0.1 : 0.03, scale);
  }
  std::vector<std::string> free;
  for (const Parameter& parameter : posterior.table().continuous) free.push_back(parameter.name);
  for (std::size_t i = 0; i < agreements.size(); ++i)
    EXPECT_GE(agreements[i], jagged[i] ? 2 : kPoints - 1) << free[i];
}

TEST_P(EveryMaterial, GradientIsZeroAlongJaggedCoordinatesAndElsewhereWhole) {
  const Posterior posterior(settings_for(GetParam()), synthetic_photo(GetParam(), 2));
  Rng rng(8);
  const Position position = at_prior_draw(posterior, rng, 0.7);
  const Evaluation given = posterior.evaluate(position),
                   whole = posterior.evaluate_with_whole_gradient(position);
  EXPECT_EQ(given.log_density, whole.log_density);
  for (Eigen::Index i = 0; i < posterior.dimension(); ++i) {
    const bool jagged = posterior.jagged()[static_cast<std::size_t>(i)];
    EXPECT_EQ(given.gradient[i], jagged ? 0 : whole.gradient[i]);
  }
}

TEST_P(EveryMaterial, IsFiniteAtTheCornersOfTheBox) {
  const Posterior posterior(settings_for(GetParam()), synthetic_photo(GetParam(), 2));
  Rng rng(11);
  for (int corner = 0; corner < 12; ++corner) {
    Position position = at_prior_draw(posterior, rng, 1);
    for (double& u : position.continuous)
      u = corner == 0 ? -8 : corner == 1 ? 8 : (rng.uniform() < 0.5 ? -8 : 8);
    const Evaluation evaluation = posterior.evaluate(position);
    EXPECT_TRUE(std::isfinite(evaluation.log_density)) << "corner " << corner;
    EXPECT_TRUE(evaluation.gradient.allFinite());
  }
}

TEST_P(EveryMaterial, RecoversItsOwnRenderExactlyAtTheTruthByEverySummary) {
  // Same z, same parameters: the misfit vanishes and the prior alone is left.
  std::vector<std::string> summaries = summary_names();
  summaries.push_back(material_table(GetParam()).summary);
  const Image photo = synthetic_photo(GetParam(), 5);
  for (const std::string& summary : summaries) {
    PosteriorSettings settings = settings_for(GetParam());
    settings.z_seed = 5;
    settings.summary = summary;
    const Posterior posterior(settings, photo);
    Position at = posterior.position(prior_location(posterior.table()));
    EXPECT_NEAR(posterior.evaluate(at).log_density, -0.5 * at.continuous.squaredNorm(), 1e-3) << summary;
    at.continuous[0] += 1;  // the flash
    const Evaluation away = posterior.evaluate(at);
    EXPECT_LT(away.log_density, -0.5 * at.continuous.squaredNorm() - 1) << summary;
    EXPECT_TRUE(away.gradient.allFinite()) << summary;
  }
}

TEST_P(EveryMaterial, IsOversampledWhereThePixelsMeansAreFarFromTheirMiddles) {
  PosteriorSettings settings;  // at the resolution of a run
  settings.material = GetParam();
  settings.summary = "means";
  const Posterior posterior(settings, synthetic_photo(GetParam(), 2));
  const auto means = [&](int times) -> Eigen::VectorXd {
    const Image photo = sensed(GetParam(), 2, settings.resolution, times);
    return posterior.simulated_summaries({&photo, 1});
  };
  const Eigen::VectorXd truth = means(8);
  const auto off = [&](int times) { return 255 * (means(times) - truth).cwiseAbs().mean(); };  // levels
  const int oversampling = make_material(GetParam())->oversampling();
  constexpr double kFar = 1;  // levels: a fifth of what the error model grants a region's mean
  EXPECT_EQ(off(1) > kFar, oversampling > 1) << off(1);
  if (oversampling > 1) {
    EXPECT_LT(off(oversampling), off(1) / 2);
  }
}

TEST_P(EveryMaterial, ValuesAndPositionsAreInverse) {
  const Posterior posterior(settings_for(GetParam()), synthetic_photo(GetParam(), 2));
  Rng rng(3);
  const Position position = at_prior_draw(posterior, rng, 1);
  const Position back = posterior.position(posterior.values(position));
  EXPECT_LT((back.continuous - position.continuous).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_EQ(back.discrete, position.discrete);
}

INSTANTIATE_TEST_SUITE_P(Materials, EveryMaterial, testing::ValuesIn(material_names()),
                         [](const auto& info) { return info.param; });

TEST(Posterior, FixedParametersLeaveTheSpaceAndKeepTheirValue) {
  PosteriorSettings settings = settings_for("leather");
  settings.fixed = {{"rough", 0.5}, {"cells", 1}};
  const Posterior posterior(settings, synthetic_photo("leather", 2));
  const Posterior free(settings_for("leather"), synthetic_photo("leather", 2));
  EXPECT_EQ(posterior.dimension(), free.dimension() - 1);
  EXPECT_EQ(posterior.discrete_levels().size(), free.discrete_levels().size() - 1);
  Rng rng(1);
  const ParameterValues values = posterior.values(at_prior_draw(posterior, rng, 1));
  EXPECT_DOUBLE_EQ(values.continuous[*posterior.table().find_continuous("rough")], 0.5);
  EXPECT_EQ(values.discrete[*posterior.table().find_discrete("cells")], 1);
}

TEST(Posterior, AReplacedPriorBoundsTheValues) {
  PosteriorSettings settings = settings_for("bump");
  settings.priors = {{"rough", {0.3, 0.05, 0.25, 0.35}}};
  const Posterior posterior(settings, synthetic_photo("bump", 2));
  const std::size_t rough = *posterior.table().find_continuous("rough");
  Rng rng(4);
  for (int i = 0; i < 100; ++i) {
    const double value = posterior.values(at_prior_draw(posterior, rng, 3)).continuous[rough];
    EXPECT_GE(value, 0.25);
    EXPECT_LE(value, 0.35);
  }
}

TEST(Posterior, OfAQuarterSeesNoOther) {
  const Image photo = synthetic_photo("bump", 2);
  PosteriorSettings settings = settings_for("bump");
  settings.summary = "means";
  const Posterior whole(settings, photo);
  const Position middle = whole.position(prior_location(whole.table()));
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double untouched = whole.of_quarter(quarter, photo).value(middle).log_density;
    for (int dark = 0; dark < 4; ++dark) {
      Image darkened = photo;
      const int half = photo.width / 2, top = dark / 2 * half, left = dark % 2 * half;
      for (int row = 0; row < half; ++row)
        for (int column = 0; column < half; ++column)
          for (int c = 0; c < 3; ++c) darkened.at(top + row, left + column, c) *= 0.5f;
      const double seen = whole.of_quarter(quarter, darkened).value(middle).log_density;
      if (dark == quarter)
        EXPECT_LT(seen, untouched - 1) << quarter;
      else
        EXPECT_EQ(seen, untouched) << quarter << ' ' << dark;
    }
  }
}

TEST(Posterior, CoordinatesOfEitherSignAreThoseAlongWhichRingsMayBeMirrored) {
  const auto names = [](const std::string& material) {
    const Posterior posterior(settings_for(material), synthetic_photo(material, 1));
    std::vector<std::string> names;
    for (const Eigen::Index i : posterior.of_either_sign())
      names.push_back(posterior.table().continuous[static_cast<std::size_t>(i)].name);
    return names;
  };
  EXPECT_EQ(names("wood"), (std::vector<std::string>{"center_x", "center_y", "center_z", "cut_angle"}));
  EXPECT_TRUE(names("leather").empty()) << "shifts are places";
}

TEST(Posterior, APositionThatIsNotFiniteIsOutsideTheSupport) {
  const Posterior posterior(settings_for("bump"), synthetic_photo("bump", 2));
  Position position{Eigen::VectorXd::Zero(posterior.dimension()), Eigen::VectorXi(0)};
  position.continuous[2] = std::numeric_limits<double>::quiet_NaN();
  const Evaluation evaluation = posterior.evaluate(position);
  EXPECT_EQ(evaluation.log_density, -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(evaluation.gradient.isZero());
}

TEST(Posterior, UserMistakesAreSentences) {
  const Image photo = synthetic_photo("bump", 2);
  const auto refuses = [&](auto&& change) {
    PosteriorSettings settings = settings_for("bump");
    change(settings);
    EXPECT_THROW(Posterior(settings, photo), UserError);
  };
  refuses([](PosteriorSettings& s) { s.material = "velvet"; });
  refuses([](PosteriorSettings& s) { s.summary = "vibes"; });
  refuses([](PosteriorSettings& s) { s.network = "/nowhere/net.safetensors"; });
  refuses([](PosteriorSettings& s) { s.resolution = 2; });
  refuses([](PosteriorSettings& s) { s.fixed = {{"nosuch", 1}}; });
  refuses([](PosteriorSettings& s) { s.fixed = {{"rough", 7}}; });
  refuses([](PosteriorSettings& s) { s.priors = {{"nosuch", {0, 1, 0, 1}}}; });
  refuses([](PosteriorSettings& s) { s.priors = {{"rough", {0, -1, 0, 1}}}; });
}

}  // namespace
}  // namespace patina
