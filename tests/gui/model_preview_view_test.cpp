#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "gui/preview/preview_view.h"

namespace patina {
namespace {

TEST(PreviewViewTest, AComparisonBringsBackTheRenderAsPhotographed) {
  PreviewView view;
  view.subject = Subject::sphere;
  view.compare(Comparison::difference);
  EXPECT_EQ(view.subject, Subject::photographed);
  EXPECT_EQ(view.effective_comparison(), Comparison::difference);
}

TEST(PreviewViewTest, OnlyTheRenderAsPhotographedIsCompared) {
  for (const Subject subject : kSubjects) {
    PreviewView view;
    view.compare(Comparison::flicker);
    view.subject = subject;
    const bool compared = view.effective_comparison() != Comparison::off;
    EXPECT_EQ(compared, subject == Subject::photographed) << subject_text(subject);
  }
}

TEST(PreviewViewTest, TheWipeStaysInsideThePictureAndExposureInsideItsLimits) {
  PreviewView view;
  view.wipe_to(1.7f);
  EXPECT_EQ(view.wipe, 1);
  view.wipe_to(-3);
  EXPECT_EQ(view.wipe, 0);
  EXPECT_EQ(view.comparison, Comparison::wipe);
  for (int i = 0; i < 100; ++i) view.expose(0.5f);
  EXPECT_EQ(view.stops, PreviewView::kMostStops);
  for (int i = 0; i < 100; ++i) view.expose(-0.5f);
  EXPECT_EQ(view.stops, -PreviewView::kMostStops);
}

TEST(PreviewViewTest, EverySubjectAndComparisonHasANameOfItsOwn) {
  std::vector<std::string> names;
  for (const Subject subject : kSubjects) names.push_back(subject_text(subject));
  for (const Comparison comparison : kComparisons) names.push_back(comparison_text(comparison));
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::unique(names.begin(), names.end()), names.end());
  EXPECT_FALSE(names.front().empty());
}

TEST(PreviewViewTest, FlickerShowsBothForEquallyLong) {
  int photo = 0;
  for (int i = 0; i < 1000; ++i) photo += flicker_shows_photo(i * 2 * kFlickerSeconds / 1000);
  EXPECT_EQ(photo, 500);
}

TEST(OrbitTest, ItsFrameStaysARotationHoweverItIsTurned) {
  Orbit orbit;
  for (int i = 0; i < 200; ++i) {
    orbit.turn(0.37f, i % 7 == 0 ? -1.1f : 0.4f);
    const Eigen::Matrix3f frame = orbit.frame();
    EXPECT_TRUE((frame.transpose() * frame).isIdentity(1e-5f));
    EXPECT_NEAR(frame.determinant(), 1, 1e-5);
    EXPECT_GT(frame(1, 1), 0) << "up stays up";
  }
}

TEST(OrbitTest, TurningRightMovesTheEyeToTheRightAndUpUp) {
  Orbit orbit;
  EXPECT_NEAR(orbit.eye().x(), 0, 1e-6);
  EXPECT_GT(orbit.eye().z(), 0);
  orbit.turn(0.3f, 0.2f);
  EXPECT_GT(orbit.eye().x(), 0);
  EXPECT_GT(orbit.eye().y(), 0);
}

TEST(OrbitTest, ApproachStopsAtItsLimits) {
  Orbit orbit;
  for (int i = 0; i < 100; ++i) orbit.approach(1);
  EXPECT_NEAR(orbit.eye().norm(), Orbit::kNearest, 1e-4);
  for (int i = 0; i < 100; ++i) orbit.approach(-1);
  EXPECT_NEAR(orbit.eye().norm(), Orbit::kFurthest, 1e-4);
}

TEST(OrbitTest, TheOriginIsInTheMiddleAndWhatIsNearerIsLargerAndInFront) {
  Orbit orbit;
  orbit.turn(0.8f, -0.5f);
  const auto seen = [&](const Eigen::Vector3f& point) {
    const Eigen::Vector4f clip = orbit.projection() * point.homogeneous();
    return Eigen::Vector3f(clip.head<3>() / clip.w());
  };
  EXPECT_TRUE(seen(Eigen::Vector3f::Zero()).head<2>().isZero(1e-6f));
  const Eigen::Vector3f right = orbit.frame().col(0), up = orbit.frame().col(1), near = orbit.frame().col(2);
  EXPECT_GT(seen(right).x(), 0.1f);
  EXPECT_NEAR(seen(right).y(), 0, 1e-5);
  EXPECT_GT(seen(up).y(), 0.1f);
  EXPECT_GT(seen(right + near).x(), seen(right).x());
  EXPECT_LT(seen(near).z(), seen(-near).z());
  EXPECT_LT(std::abs(seen(near).z()), 1);
  EXPECT_LT(std::abs(seen(-near).z()), 1);
}

TEST(LightTest, StandsOverThePointerAndNeverBehindTheShape) {
  for (float y = -1; y <= 1; y += 0.25f)
    for (float x = -1; x <= 1; x += 0.25f) {
      const Eigen::Vector3f light = light_under(x, y);
      EXPECT_NEAR(light.norm(), 1, 1e-5);
      EXPECT_GE(light.z(), 0.199f);
      EXPECT_NEAR(light.x() * y, light.y() * x, 1e-5) << "in the pointer's direction";
      EXPECT_GE(light.x() * x + light.y() * y, 0);
    }
  EXPECT_TRUE(light_under(0.3f, -0.4f).head<2>().isApprox(Eigen::Vector2f(0.3f, -0.4f)));
}

}  // namespace
}  // namespace patina
