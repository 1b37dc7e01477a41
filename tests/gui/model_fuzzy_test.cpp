#include <gtest/gtest.h>

#include "gui/fuzzy.h"

namespace patina {
namespace {

TEST(FuzzyTest, FindsLettersInTheirOrderWhateverTheirCase) {
  EXPECT_TRUE(fuzzy_score("ssr", "Side by Side Render"));
  EXPECT_TRUE(fuzzy_score("WIPE", "wipe between photo and render"));
  EXPECT_TRUE(fuzzy_score("ph re", "Wipe between photo and render")) << "blanks do not count";
  EXPECT_FALSE(fuzzy_score("epiw", "wipe"));
  EXPECT_FALSE(fuzzy_score("wipes", "wipe"));
  EXPECT_FALSE(fuzzy_score("x", ""));
}

TEST(FuzzyTest, NothingTypedFindsEverythingAlike) {
  EXPECT_EQ(fuzzy_score("", "Wipe"), fuzzy_score("", "Open a photo or a run"));
  EXPECT_EQ(fuzzy_score("  ", "Wipe"), fuzzy_score("", "Wipe"));
}

TEST(FuzzyTest, PrefersBeginningsOfWordsThenRunsOfLettersThenShorterTexts) {
  EXPECT_GT(fuzzy_score("or", "Open a run"), fuzzy_score("or", "before"));
  EXPECT_GT(fuzzy_score("run", "Stop the run"), fuzzy_score("run", "Read a duration"));
  EXPECT_GT(fuzzy_score("abc", "xabcx"), fuzzy_score("abc", "xaxbxcx"));
  EXPECT_GT(fuzzy_score("stop", "Stop"), fuzzy_score("stop", "Stop the run that was begun before this one"));
}

TEST(FuzzyTest, TakesTheBestOfSeveralPlaces) {
  // The first r is inside a word; the second begins one.
  EXPECT_EQ(fuzzy_score("r", "xr r"), fuzzy_score("r", "xx r"));
}

}  // namespace
}  // namespace patina
