#include "engine/calibration/outcome_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <limits>

#include "engine/error.h"
#include "engine/io/file.h"

namespace patina {
namespace {

class OutcomeFileTest : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::remove(file_); }
  void TearDown() override { std::filesystem::remove(file_); }

  static PhotoOutcome outcome(int photo) {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    return {photo, 1.5, 1.02, 300, kNaN, 1, 450, {{0.25, kNaN, 1.01}, {0.75, 0.5, 1.0}}};
  }

  const std::filesystem::path file_ =
      std::filesystem::path(testing::TempDir()) / ("outcomes-" + std::to_string(getpid()) + ".csv");
  const std::vector<std::string> names_{"lp", "rough"};
};

TEST_F(OutcomeFileTest, HoldsPhotosInOrderAndIsReadBackByWhoKnowsNothingOfIt) {
  OutcomeFile file(file_, "a study", names_);
  file.add(outcome(7));
  file.add(outcome(2));
  const OutcomeFile again = OutcomeFile::read(file_);
  EXPECT_EQ(again.study(), "a study");
  EXPECT_EQ(again.quantities(), names_);
  ASSERT_EQ(again.outcomes().size(), 2u);
  EXPECT_EQ(again.outcomes()[0].photo, 2);
  EXPECT_TRUE(again.has(7));
  EXPECT_FALSE(again.has(3));
  EXPECT_EQ(again.outcomes()[1].quantities[1].place, 0.75);
  EXPECT_EQ(again.outcomes()[1].simulated, 450);
  EXPECT_TRUE(std::isnan(again.outcomes()[1].distance));
}

TEST_F(OutcomeFileTest, OfAnotherStudyIsRefused) {
  OutcomeFile(file_, "a study", names_).add(outcome(1));
  EXPECT_THROW(OutcomeFile(file_, "another study", names_), UserError);
  EXPECT_THROW(OutcomeFile(file_, "a study", {"lp"}), UserError);
}

TEST_F(OutcomeFileTest, ThatIsMissingOrDamagedIsAUserError) {
  EXPECT_THROW(OutcomeFile::read(file_), UserError);
  OutcomeFile(file_, "a study", names_).add(outcome(1));
  write_file_atomically(file_, read_file(file_) + "1,2,3\n");
  EXPECT_THROW(OutcomeFile::read(file_), UserError);
}

}  // namespace
}  // namespace patina
