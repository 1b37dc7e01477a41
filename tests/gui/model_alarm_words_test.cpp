#include <gtest/gtest.h>

#include "gui/alarm_words.h"

namespace patina {
namespace {

TEST(AlarmWords, NameTheWindowsControlInPlaceOfAnOption) {
  EXPECT_EQ(by_controls("Errors learnt (--errors calibrated) average; hand-set (--errors paper) do not."),
            "Errors learnt (Rules..., learnt from simulated photos) average; hand-set (Rules..., as usual "
            "between renders and photos) do not.");
  EXPECT_EQ(by_controls("The photo may want a wider prior of it (--prior)."),
            "The photo may want a wider prior of it.");
}

TEST(AlarmWords, SayOfAnOptionWithoutAControlWhoHasIt) {
  EXPECT_EQ(by_controls("Draw four (--chains 4), or longer (--warmup)."),
            "Draw four (patina-cli fit --chains 4), or longer (patina-cli fit --warmup).");
}

TEST(AlarmWords, LeaveTheRestAsItIs) {
  const std::string plain = "Chains sit in matches of their own (R-hat 1.84 of scale): look.";
  EXPECT_EQ(by_controls(plain), plain);
}

}  // namespace
}  // namespace patina
