#include "engine/run/manifest.h"
#include "tests/run/run_fixture.h"

namespace patina {
namespace {

class TemperedRun : public RunTest {
 protected:
  static RunSettings tempered() {
    RunSettings tempered = settings();
    tempered.temper = 3;
    return tempered;
  }
};

TEST_F(TemperedRun, SaysSoInRunJsonAndIsAnotherRunThanThePlainOne) {
  const auto run = start(tempered());
  EXPECT_EQ(draws_to_the_end(*run).size(), 2u * (40 + 30));
  EXPECT_EQ(run->status().phase, RunPhase::finished) << run->status().message;
  EXPECT_EQ(read_manifest(directory()).settings.temper, 3);
  draws_to_the_end(*start_run(settings(), photo(), folder_ / "plain"));
  EXPECT_NE(rows_of(directory() / "chain-1.csv"), rows_of(folder_ / "plain" / "chain-1.csv"));
}

TEST_F(TemperedRun, IsNotTakenUpAgainWithoutItsLadder) {
  draws_to_the_end(*start(tempered()));
  const std::string before = slurp(directory() / "chain-1.csv");
  for (const int temper : {0, 4}) {
    RunSettings other = tempered();
    other.temper = temper;
    const std::string sentence = user_error([&] { resume_run(other, photo(), directory()); });
    EXPECT_NE(sentence.find("settings/temper (3, not " + std::to_string(temper) + ")"), std::string::npos)
        << sentence;
  }
  EXPECT_EQ(slurp(directory() / "chain-1.csv"), before);
}

}  // namespace
}  // namespace patina
