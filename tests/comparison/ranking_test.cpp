#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/comparison/material_evidence.h"
#include "engine/comparison/rank_materials.h"
#include "engine/comparison/ranking_words.h"
#include "engine/error.h"
#include "engine/material/registry.h"
#include "tests/run/run_fixture.h"

namespace patina {
namespace {

RankedMaterial material(const std::string& name, double log_evidence, std::optional<double> error,
                        int parameters) {
  RankedMaterial material;
  material.material = name;
  material.log_evidence = log_evidence;
  material.error = error;
  material.parameters = parameters;
  return material;
}

std::string first_of(std::vector<RankedMaterial> materials) {
  put_in_order(materials);
  return materials.front().material;
}

TEST(Ranking, prefers_the_simpler_of_two_only_within_the_error_of_their_evidences) {
  EXPECT_EQ(first_of({material("plain", -11, 0.5, 8), material("rich", -10, 0.5, 20)}), "plain");
  EXPECT_EQ(first_of({material("plain", -12, 0.5, 8), material("rich", -10, 0.5, 20)}), "rich");
  EXPECT_EQ(first_of({material("rich", -11, 0.5, 20), material("plain", -10, 0.5, 8)}), "plain");
  EXPECT_EQ(first_of({material("plain", -13, {}, 8), material("rich", -10, {}, 20)}), "plain")
      << "a first cut is no better than that";
}

TEST(Ranking, counts_what_is_seen_at_a_glance_as_odds_before_the_evidence) {
  RankedMaterial smooth = material("smooth", -10, 0.5, 8), rough = material("rough", -14, 0.5, 8);
  EXPECT_EQ(first_of({smooth, rough}), "smooth");
  smooth.glance = std::log(0.001), rough.glance = std::log(0.999);
  std::vector<RankedMaterial> all{smooth, rough};
  put_in_order(all);
  EXPECT_EQ(all[0].material, "rough");
  EXPECT_NEAR(all[0].probability / all[1].probability, 999 * std::exp(-4.0), 1e-9);
  rough.log_evidence = -20;
  EXPECT_EQ(first_of({smooth, rough}), "smooth") << "evidence can overrule it";
}

TEST(Ranking, prefers_what_foretells_quarters_of_the_photo_where_evidences_are_within_error) {
  RankedMaterial plain = material("plain", -11, 0.5, 8), rich = material("rich", -10, 0.5, 20);
  plain.quarters = {-9, -8, -9, -8};
  rich.quarters = {-6, -5, -5, -6};
  EXPECT_EQ(first_of({plain, rich}), "rich");
  plain.quarters = {-9, -2, -7, -3};
  EXPECT_EQ(first_of({plain, rich}), "plain") << "no clear difference";
  plain.quarters = {-3, -2, -3, -2};
  plain.log_evidence = -20;
  EXPECT_EQ(first_of({plain, rich}), "rich") << "quarters decide between equals alone";
}

TEST(Ranking, says_what_quarters_decided) {
  MaterialRanking ranking;
  ranking.materials = {material("leather", -10, 0.5, 15), material("plaster", -9.5, 0.5, 13)};
  ranking.materials[0].quarters = {-6, -5, -5, -6};
  ranking.materials[1].quarters = {-9, -8, -9, -8};
  EXPECT_NE(in_words(ranking).find("leather foretells quarters"), std::string::npos) << in_words(ranking);
  ranking.materials[1].quarters = ranking.materials[0].quarters;
  EXPECT_EQ(in_words(ranking).find("foretells"), std::string::npos) << in_words(ranking);
}

TEST(Ranking, probabilities_are_those_of_equally_likely_materials) {
  std::vector<RankedMaterial> all{material("a", -1000, 0.1, 1), material("b", -1000 + std::log(3), 0.1, 2)};
  put_in_order(all);
  ASSERT_EQ(all[0].material, "b");
  EXPECT_NEAR(all[0].probability, 0.75, 1e-12);
  EXPECT_NEAR(all[1].probability, 0.25, 1e-12);
}

TEST(Ranking, says_by_how_much_the_first_is_ahead_or_that_it_is_not) {
  MaterialRanking ranking;
  ranking.materials = {material("leather", -10, 0.1, 15), material("plaster", -10 - std::log(12), 0.1, 13)};
  EXPECT_EQ(in_words(ranking), "leather, 12 times likelier than plaster, the next.");
  ranking.materials[1].error = 2;
  EXPECT_NE(in_words(ranking).find("cannot tell them apart"), std::string::npos);
  ranking.materials[1] = material("plaster", -10 - 40 * std::log(10), 0.1, 13);
  EXPECT_NE(in_words(ranking).find("10^40"), std::string::npos) << in_words(ranking);
}

TEST(Ranking, says_that_none_fits_where_the_best_match_is_a_poor_one) {
  MaterialRanking ranking;
  ranking.materials = {material("leather", -10, 0.1, 15), material("plaster", -20, 0.1, 13)};
  ranking.materials[0].misfit = 1.2;
  EXPECT_EQ(in_words(ranking).find("None of them fits"), std::string::npos);
  ranking.materials[0].misfit = 3.4;
  ranking.materials[0].misfit_of_another_sample = 0.3;
  const std::string words = in_words(ranking);
  for (const char* part : {"None of them fits", "leather", "3.4", "0.3"})
    EXPECT_NE(words.find(part), std::string::npos) << part << " in: " << words;
}

/// Rankings by mean colours alone, which take a second.
class RankMaterials : public RunTest {
 protected:
  static RankSettings quick() {
    RankSettings settings;
    settings.materials = {"translucent", "bump"};
    settings.summary = "means";
    settings.resolution = 32;
    settings.finalists = 0;
    return settings;
  }

  /// Of the material bump, and red: what no grey medium can be.
  static Image red_bump(int side = 48) {
    const Renderer renderer("bump", 2, Capture{});
    ParameterValues values = prior_location(renderer.table());
    values.continuous[*renderer.table().find_continuous("albedo_r")] = 0.7;
    values.continuous[*renderer.table().find_continuous("albedo_g")] = 0.1;
    return renderer.render(values, side);
  }
};

TEST(Ranking, expects_the_same_light_and_vignetting_in_a_picture_whatever_its_size) {
  // A sample twice as large from twice as far is the same picture of a surface
  // that is the same in units of its side: four times the light, and a falloff twice as wide.
  Capture near, far;
  near.size_cm = 10, far.size_cm = 20;
  near.camera_cm = 12, far.camera_cm = 24;
  for (const std::string& material : material_names()) {
    const auto at_near = camera_priors(material, near), at_far = camera_priors(material, far);
    ASSERT_EQ(at_near.size(), at_far.size()) << material;
    for (const auto& [name, prior] : at_near) {
      const double scale = name == "light" ? 4 : 2;
      const TruncatedNormal& other = at_far.at(name);
      EXPECT_DOUBLE_EQ(other.mean, scale * prior.mean) << material << ' ' << name;
      EXPECT_DOUBLE_EQ(other.sd, scale * prior.sd) << material << ' ' << name;
      EXPECT_DOUBLE_EQ(other.low, scale * prior.low) << material << ' ' << name;
      EXPECT_DOUBLE_EQ(other.high, scale * prior.high) << material << ' ' << name;
    }
  }
}

TEST_F(RankMaterials, puts_the_material_first_that_made_the_photo) {
  double furthest = 0;
  const auto ranking = rank_materials(red_bump(), quick(), [&](double fraction, const std::string& doing) {
    EXPECT_GE(fraction, furthest);
    EXPECT_FALSE(doing.empty());
    furthest = fraction;
  });
  ASSERT_TRUE(ranking);
  EXPECT_NEAR(furthest, 1, 1e-9);
  ASSERT_EQ(ranking->materials.size(), 2u);
  EXPECT_EQ(ranking->materials[0].material, "bump");
  EXPECT_GT(ranking->materials[0].log_evidence, ranking->materials[1].log_evidence + 10);
  EXPECT_FALSE(ranking->materials[0].error) << "a first cut has no error to tell";
  EXPECT_EQ(ranking->materials[0].quarters.size(), 4u);
  EXPECT_NEAR(std::exp(ranking->materials[0].glance) + std::exp(ranking->materials[1].glance), 1, 1e-9);
  EXPECT_TRUE(foretells_worse(ranking->materials[1], ranking->materials[0]));
  EXPECT_FALSE(foretells_worse(ranking->materials[0], ranking->materials[1]));
  const ParameterTable table = Renderer("bump", 1, Capture{}).table();
  const std::vector<double>& match = ranking->materials[0].match.continuous;
  EXPECT_GT(match[*table.find_continuous("albedo_r")], 2 * match[*table.find_continuous("albedo_g")]);
}

TEST_F(RankMaterials, glances_at_all_of_them_in_no_time_and_leaves_out_what_takes_a_search) {
  RankSettings settings;
  settings.glance = true;
  const Image photo = red_bump(256);
  const auto all = rank_materials(photo, settings);
  ASSERT_TRUE(all);
  EXPECT_EQ(all->materials.size(), material_names().size());
  EXPECT_EQ(all->materials.front().material, "bump");
  double total = 0;
  for (const RankedMaterial& m : all->materials) {
    EXPECT_FALSE(m.misfit || m.error);
    EXPECT_TRUE(m.quarters.empty());
    EXPECT_EQ(m.match.continuous.size(), material_table(m.material).continuous.size());
    total += m.probability;
  }
  EXPECT_NEAR(total, 1, 1e-9);
  EXPECT_NE(all->sentence.find("bump"), std::string::npos);
  settings.materials = {"wood", "metal"};
  EXPECT_EQ(rank_materials(photo, settings)->materials.size(), 2u);
}

TEST(Ranking, a_run_that_chooses_for_itself_glances) {
  EXPECT_TRUE(first_cut(RunSettings{}, Capture{}).glance);
}

// The paper's Figure 8: what is not the photo's material is recognised as such.
TEST_F(RankMaterials, says_that_none_fits_when_the_photos_material_is_not_among_them) {
  RankSettings settings = quick();
  settings.materials = {"translucent"};
  const auto without = rank_materials(red_bump(), settings);
  EXPECT_NE(without->sentence.find("None of them fits"), std::string::npos) << without->sentence;
  EXPECT_GT(without->materials[0].misfit, kPoorMatch);
  settings.materials = {"bump"};
  const auto with = rank_materials(red_bump(), settings);
  EXPECT_EQ(with->sentence.find("None of them fits"), std::string::npos) << with->sentence;
  EXPECT_LT(with->materials[0].misfit, 1);
  EXPECT_LT(with->materials[0].misfit_of_another_sample, 1);
}

TEST_F(RankMaterials, finds_by_sequential_monte_carlo_what_laplace_finds_about) {
  RankSettings settings = quick();
  settings.materials = {"bump", "plaster"};
  const auto laplace = rank_materials(red_bump(), settings);
  settings.finalists = 2;
  settings.particles = 16;
  const auto measured = rank_materials(red_bump(), settings);
  ASSERT_TRUE(laplace && measured);
  for (const RankedMaterial& m : measured->materials) {
    ASSERT_TRUE(m.error) << "both explain mean colours: they are close, and measured again";
    const auto same = std::ranges::find(laplace->materials, m.material, &RankedMaterial::material);
    EXPECT_NEAR(m.log_evidence, same->log_evidence, 3 + 3 * *m.error) << m.material;
  }
}

TEST_F(RankMaterials, goes_without_quarters_where_they_have_too_few_pixels_for_the_summary) {
  RankSettings settings = quick();
  settings.materials = {"translucent"};
  settings.summary = "gram";
  const auto ranking = rank_materials(red_bump(), settings);
  ASSERT_TRUE(ranking);
  EXPECT_TRUE(ranking->materials[0].quarters.empty());
}

TEST_F(RankMaterials, does_not_depend_on_the_threads) {
  RankSettings one = quick();
  one.materials = {"bump"};
  RankSettings two = one;
  one.threads = 1;
  two.threads = 2;
  EXPECT_EQ(rank_materials(red_bump(), one)->materials[0].log_evidence,
            rank_materials(red_bump(), two)->materials[0].log_evidence);
}

TEST_F(RankMaterials, returns_nothing_after_a_stop) {
  std::stop_source stop;
  int calls = 0;
  const auto ranking = rank_materials(
      red_bump(), quick(),
      [&](double, const std::string&) { ++calls == 3 ? void(stop.request_stop()) : void(); },
      stop.get_token());
  EXPECT_FALSE(ranking);
  EXPECT_LT(calls, 20) << "it went on";
}

TEST_F(RankMaterials, refuses_what_cannot_be) {
  const auto refused = [&](auto change) {
    RankSettings settings = quick();
    change(settings);
    EXPECT_THROW(rank_materials(red_bump(), settings), UserError);
  };
  refused([](RankSettings& s) { s.materials = {"bump", "bump"}; });
  refused([](RankSettings& s) { s.materials = {"cheese"}; });
  refused([](RankSettings& s) { s.resolution = 31; });
  refused([](RankSettings& s) { s.capture.size_cm = 0; });
  refused([](RankSettings& s) { s.summary = "taste"; });
}

}  // namespace
}  // namespace patina
