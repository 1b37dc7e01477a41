#include "engine/run/photo_alarms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "engine/io/photo.h"

namespace patina {
namespace {

/// A highlight at (x, y), in sides from the middle, on a dim ground.
Image highlight(double x, double y, double gain = 1, int side = 96) {
  Image image(side, side, 3);
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const double dx = (column + 0.5) / side - 0.5 - x, dy = (row + 0.5) / side - 0.5 - y;
      const double value = gain * (0.1 + 0.7 * std::exp(-20 * (dx * dx + dy * dy)));
      for (int c = 0; c < 3; ++c) image.at(row, column, c) = static_cast<float>(std::clamp(value, 0.0, 1.0));
    }
  return image;
}

std::string names_of(const Image& image) {
  std::string names;
  for (const Alarm& alarm : photo_alarms(image)) names += alarm.name + ";";
  return names;
}

TEST(PhotoAlarms, a_highlight_in_the_middle_raises_none) {
  EXPECT_EQ(names_of(highlight(0, 0)), "");
  EXPECT_EQ(names_of(highlight(0.1, -0.1)), "");
}

TEST(PhotoAlarms, a_highlight_far_from_the_middle_is_told) {
  EXPECT_EQ(names_of(highlight(0.35, 0)), "off centre;");
  EXPECT_EQ(names_of(highlight(-0.3, 0.3)), "off centre;");
}

TEST(PhotoAlarms, black_and_burnt_out_photos_are_told) {
  EXPECT_EQ(names_of(highlight(0, 0, 0.02)), "dark;");
  EXPECT_EQ(names_of(highlight(0, 0, 5)), "burnt out;");
  EXPECT_EQ(names_of(highlight(0, 0, 1.4)), "") << "a clipped highlight is usual";
}

Image times(Image image, float red, float green, float blue) {
  const float by[] = {red, green, blue};
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = std::min(1.0F, by[i % 3] * image.pixels[i]);
  return image;
}

TEST(PhotoAlarms, a_highlight_that_was_clipped_and_tinted_afterwards_is_told) {
  const Image burnt = highlight(0, 0, 1.6);
  EXPECT_EQ(names_of(burnt), "");
  EXPECT_EQ(names_of(times(burnt, 1, 1, 0.7F)), "clipped;");
  EXPECT_EQ(names_of(times(burnt, 0.8F, 0.8F, 0.8F)), "clipped;");
  EXPECT_EQ(names_of(times(highlight(0, 0), 1, 1, 0.7F)), "") << "tinted, but never clipped";
}

TEST(PhotoAlarms, a_photo_of_one_value_is_blank_whatever_the_value) {
  for (const float value : {0.0F, 0.5F, 1.0F}) {
    Image image(64, 64, 3);
    std::ranges::fill(image.pixels, value);
    EXPECT_EQ(names_of(image), "blank;");
  }
}

TEST(PhotoAlarms, nine_real_photos_raise_none) {
  const std::filesystem::path folder = std::filesystem::path(PATINA_SHARED_DIR) / "photos";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no photos in " << folder;
  int photos = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".jpg") continue;
    EXPECT_EQ(names_of(load_photo(entry.path()).image), "") << entry.path();
    ++photos;
  }
  EXPECT_EQ(photos, 9);
}

}  // namespace
}  // namespace patina
