#include "engine/material/capture_priors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/material/registry.h"
#include "engine/material/renderer.h"

namespace patina {
namespace {

constexpr Capture kNear{10, 25 * 10 / 21.21};

/// The picture of a flat sample of typical colour, roughness and light.
Image typical_flat_photo(const Capture& capture, const ParameterTable& table) {
  ParameterValues values = prior_location(table);
  values.continuous[*table.find_continuous("fscale")] = 0;
  return Renderer("bump", 1, capture).render(values, 32);
}

double largest_difference(const Image& a, const Image& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    largest = std::max(largest, std::abs(double{a.pixels[i]} - b.pixels[i]));
  return largest;
}

TEST(CapturePriors, AFlatSampleHalfAsLargeFromHalfAsFarIsTypicallyTheSamePicture) {
  const ParameterTable table = material_table("bump");
  const Image far = typical_flat_photo(Capture(), table_under(table, Capture()));
  EXPECT_LT(largest_difference(far, typical_flat_photo(kNear, table_under(table, kNear))), 1e-4);
  EXPECT_GT(largest_difference(far, typical_flat_photo(kNear, table)), 0.2) << "four times the light";
}

TEST(CapturePriors, OnlyLightAndItsReachDependOnTheCamera) {
  for (const std::string& name : material_names()) {
    const ParameterTable table = material_table(name), under = table_under(table, kNear);
    for (std::size_t i = 0; i < table.continuous.size(); ++i) {
      const TruncatedNormal &own = table.continuous[i].prior, &prior = under.continuous[i].prior;
      const double farther = kNear.camera_cm / 25;
      const double scale = table.continuous[i].name == "light"    ? farther * farther
                           : table.continuous[i].name == "iSigma" ? farther
                                                                  : 1;
      EXPECT_DOUBLE_EQ(prior.mean, own.mean * scale) << name << " " << table.continuous[i].name;
      EXPECT_DOUBLE_EQ(prior.sd, own.sd * scale);
      EXPECT_DOUBLE_EQ(prior.low, own.low * scale);
      EXPECT_DOUBLE_EQ(prior.high, own.high * scale);
    }
  }
}

TEST(CapturePriors, AreThoseOfTheFileForTheDefaultCameraAndAreNotAppliedTwice) {
  const ParameterTable table = material_table("leather"), once = table_under(table, kNear);
  const ParameterTable same = table_under(table, Capture()), twice = table_under(once, kNear);
  for (std::size_t i = 0; i < table.continuous.size(); ++i) {
    EXPECT_EQ(same.continuous[i].prior, table.continuous[i].prior);
    EXPECT_EQ(twice.continuous[i].prior, once.continuous[i].prior);
  }
}

}  // namespace
}  // namespace patina
