#include <gtest/gtest.h>

#include <string>

#include "engine/error.h"
#include "tests/run/run_fixture.h"

// What holds of every run whose errors are measured before it draws.

namespace patina {
namespace {

class MeasuredErrors : public RunTest, public testing::WithParamInterface<std::string> {
 protected:
  static RunSettings measured() { return with_errors(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(AveragedAndCalibrated, MeasuredErrors, testing::Values("averaged", "calibrated"));

TEST_P(MeasuredErrors, OfARunThatIsTakenUpAgainLeadToTheDrawsOfAnUndisturbedOne) {
  RunSettings asked = measured();
  draws_to_the_end(*start_run(asked, photo(), folder_ / "undisturbed"));
  asked.draws = 5;
  draws_to_the_end(*start(asked));
  asked.draws = measured().draws;
  draws_to_the_end(*resume_run(asked, photo(), directory()));
  EXPECT_EQ(rows_of(directory() / "chain-1.csv"), rows_of(folder_ / "undisturbed" / "chain-1.csv"));
}

TEST_P(MeasuredErrors, OfARunAreNotTakenUpAsHandSetOnes) {
  draws_to_the_end(*start(measured()));
  RunSettings other = measured();
  other.errors = "paper";
  EXPECT_THROW(resume_run(other, photo(), directory()), UserError);
}

}  // namespace
}  // namespace patina
