#include "engine/run/run_alarms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/material/renderer.h"
#include "tests/run/odd_photos.h"
#include "tests/run/run_fixture.h"

namespace patina {
namespace {

TEST(RunAlarms, a_misfit_within_the_granted_error_raises_none) {
  EXPECT_FALSE(misfit_alarm({}));
  EXPECT_FALSE(misfit_alarm({{"gram 1", false, 0.27, 1}, {"4 ring means", true, 0.07, 2.4}}));
}

TEST(RunAlarms, the_worst_part_of_a_misfit_is_told_in_its_own_unit) {
  const auto texture = misfit_alarm({{"gram 1", false, 0.27, 1}, {"gram 3", false, 0.81, 3}});
  ASSERT_TRUE(texture);
  EXPECT_EQ(texture->name, "misfit");
  for (const char* words : {"gram 3", "81 %", "27 %"})
    EXPECT_NE(texture->sentence.find(words), std::string::npos) << texture->sentence;
  const auto colour = misfit_alarm({{"gram 1", false, 0.8, 3}, {"4 ring means", true, 0.12, 4}});
  ASSERT_TRUE(colour);
  for (const char* words : {"31 of 255", "off by 8"})
    EXPECT_NE(colour->sentence.find(words), std::string::npos) << colour->sentence;
}

TEST(RunAlarms, a_photo_that_is_further_than_simulated_ones_is_told_with_how_far_intervals_were_widened) {
  EXPECT_FALSE(fit_alarm({1, 0.5, 1}, "leather"));
  EXPECT_FALSE(fit_alarm({1.1, 0.04, 1.2}, "leather")) << "one photo in twenty is as far";
  const auto far = fit_alarm({3.2, 0.003, 9}, "leather");
  ASSERT_TRUE(far);
  for (const char* words : {"does not look like leather", "3.2 times", "widened 3-fold"})
    EXPECT_NE(far->sentence.find(words), std::string::npos) << far->sentence;
}

TEST(RunAlarms, colours_are_told_where_textures_are_allowed_to_differ) {
  EXPECT_FALSE(colour_alarm({{"gram 1", false, 0.8, 4}, {"4 ring means", true, 0.04, 2}}));
  const auto off = colour_alarm({{"gram 1", false, 0.8, 40}, {"4 ring means", true, 0.12, 6}});
  ASSERT_TRUE(off);
  EXPECT_EQ(off->name, "colours");
  for (const char* words : {"31 of 255", "off by 5", "--errors paper"})
    EXPECT_NE(off->sentence.find(words), std::string::npos) << off->sentence;
}

TEST(RunAlarms, noise_is_told_above_a_tenth_of_a_nat) {
  EXPECT_FALSE(noise_alarm(0));
  EXPECT_FALSE(noise_alarm(0.099));
  ASSERT_TRUE(noise_alarm(0.4));
  EXPECT_NE(noise_alarm(0.4)->sentence.find("0.4 nats"), std::string::npos);
}

TEST(RunAlarms, a_match_that_the_prior_calls_unlikely_is_told_with_its_most_unlikely_parameter) {
  ParameterTable table;
  for (const char* name : {"a", "b", "c"}) table.continuous.push_back({name, "", "", {0, 1, -100, 100}});
  // The chi-square of 3 degrees of freedom exceeds 16.27 once in a thousand.
  EXPECT_FALSE(strain_alarm(table, {{2, -2, 2.85}, {}}, {}));
  const auto strained = strain_alarm(table, {{2, -2, 2.9}, {}}, {});
  ASSERT_TRUE(strained);
  EXPECT_NE(strained->sentence.find("c = 2.9"), std::string::npos) << strained->sentence;
  EXPECT_FALSE(strain_alarm(table, {{2, -2, 2.9}, {}}, {{"c", 2.9}})) << "it is held there";
  EXPECT_FALSE(strain_alarm({}, {}, {}));
}

TEST(RunAlarms, a_match_that_more_pixels_would_see_otherwise_is_told) {
  const Renderer renderer("bump", 1, Capture{});
  const ParameterValues values = prior_location(renderer.table());
  const auto told = [&](int resolution) {
    PosteriorSettings settings;
    settings.resolution = resolution;
    const Posterior posterior(settings, renderer.render(values, resolution));
    return coarse_alarm(posterior, posterior.position(values), renderer.render(values, 2048)).has_value();
  };
  EXPECT_TRUE(told(32)) << "its bumps fall between the pixels";
  EXPECT_FALSE(told(512));
}

class RunAlarmsOfARun : public RunTest {
 protected:
  /// The alarms of a run on an image, live and as read from its directory.
  Alarms alarms_of(const Image& image) const {
    const auto run = start_run(settings(), photo_of(image), directory());
    draws_to_the_end(*run);
    const Alarms live = run->status().alarms;
    EXPECT_EQ(open_run(directory())->status().alarms, live);
    return live;
  }
};

TEST_F(RunAlarmsOfARun, a_render_of_the_material_itself_raises_none_but_that_its_pixels_are_coarse) {
  const Alarms alarms = alarms_of(photo().image);
  ASSERT_EQ(alarms.size(), 1U);
  EXPECT_EQ(alarms.front().name, "coarse");
}

TEST_F(RunAlarmsOfARun, a_green_hole_in_white_is_far_from_any_match_and_the_directory_says_so) {
  const Alarms alarms = alarms_of(green_hole_in_white());
  EXPECT_TRUE(std::ranges::find(alarms, "misfit", &Alarm::name) != alarms.end());
}

}  // namespace
}  // namespace patina
