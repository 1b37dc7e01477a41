#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "engine/error.h"
#include "engine/io/temporary_folder.h"
#include "gui/window/preferences.h"

namespace patina {
namespace {

class PreferencesTest : public ::testing::Test {
 protected:
  Preferences read(const std::string& text) const {
    std::ofstream(file_) << text;
    return read_preferences(file_);
  }

  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "settings.json";
};

TEST_F(PreferencesTest, WhatIsWrittenIsReadAgain) {
  Preferences preferences;
  preferences.recent = {"/a/oak door.jpg", "/b/runs/plank"};
  preferences.last_folder = "/a";
  preferences.last_run = "/b/runs/plank";
  preferences.draw = {2, 12345};
  preferences.width = 1700;
  preferences.height = 950;
  preferences.shares = {0.22f, 0.35f};
  preferences.scale = 1.21f;
  preferences.light_theme = true;
  const auto file = folder_.path() / "made" / "if need be" / "settings.json";
  write_preferences(file, preferences);
  EXPECT_EQ(read_preferences(file), preferences);
  write_preferences(file, {});
  EXPECT_EQ(read_preferences(file), Preferences());
}

TEST_F(PreferencesTest, WithoutAFileAllIsAsAtFirst) { EXPECT_EQ(read_preferences(file_), Preferences()); }

TEST_F(PreferencesTest, ABrokenFileIsNamedInASentence) {
  for (const char* text : {"", "{\"width\": 12", "[1, 2]", "\xff\xfe"}) {
    try {
      read(text);
      ADD_FAILURE() << text;
    } catch (const UserError& error) {
      EXPECT_NE(std::string(error.what()).find(file_.string()), std::string::npos) << error.what();
    }
  }
}

TEST_F(PreferencesTest, WhatIsOutOfRangeOrOfAnotherKindIsAsAtFirst) {
  EXPECT_EQ(read(R"({"width": -5, "height": "tall", "scale": 1e9, "left_column": 0.9, "right_column": null,
                     "recent": "x", "draw": [1], "last_run": 7, "theme": 3})"),
            Preferences());
  EXPECT_EQ(read(R"({"draw": {"chain": -1, "iteration": 4}, "recent": [1, null]})"), Preferences());
}

TEST_F(PreferencesTest, TheNewestFilesComeFirstAndOnce) {
  Preferences preferences;
  for (int i = 0; i < 14; ++i) preferences.opened("/photos/" + std::to_string(i));
  preferences.opened("/photos/9");
  ASSERT_EQ(preferences.recent.size(), Preferences::kMostRecent);
  EXPECT_EQ(preferences.recent[0], "/photos/9");
  EXPECT_EQ(preferences.recent[1], "/photos/13");
  EXPECT_EQ(std::count(preferences.recent.begin(), preferences.recent.end(), "/photos/9"), 1);
}

}  // namespace
}  // namespace patina
