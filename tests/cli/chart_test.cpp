#include "tests/cli/cli_fixture.h"

namespace patina {
namespace {

class ChartCommand : public CliTest {
 protected:
  /// A chart that takes seconds.
  std::vector<std::string> small_chart(const std::string& out) const {
    return {"chart",  "--material",
            "bump",   "--summary",
            "means",  "--resolution",
            "32",     "--warmup",
            "40",     "--draws",
            "20",     "--repeats",
            "1",      "--minutes-per-setting",
            "0",      "--gold-minutes",
            "0",      "--out",
            path(out)};
  }

  std::string contents(const std::string& name) const { return slurp(folder_ / name); }
};

TEST_F(ChartCommand, ChartsAMaterialOfKnownTruthAndMakesNothingTwice) {
  const Finished first = run(small_chart("chart"));
  ASSERT_EQ(first.status, 0) << first.err;
  const std::string table = contents("chart/chart.csv"), drawing = contents("chart/chart.svg");
  for (const char* name : {"default", "mala", "nuts", "16 pixels"}) {
    EXPECT_NE(table.find(std::string("\n") + name + ","), std::string::npos) << name;
    EXPECT_NE(drawing.find(std::string(">") + name + "</text>"), std::string::npos) << name;
  }
  EXPECT_NE(table.find("render of a prior draw (seed 1) with irregularities 2"), std::string::npos);
  const Finished again = run(small_chart("chart"));
  EXPECT_EQ(again.status, 0);
  EXPECT_EQ(again.err.find("repeat 1"), std::string::npos) << again.err;
  EXPECT_EQ(contents("chart/chart.csv"), table);
}

TEST_F(ChartCommand, TriesOnlyWhatIsAskedForBesideTheDefault) {
  std::vector<std::string> arguments = small_chart("two");
  arguments.insert(arguments.end(), {"--only", "proposed at 16 pixels"});
  ASSERT_EQ(run(arguments).status, 0);
  const std::string table = contents("two/chart.csv");
  EXPECT_NE(table.find("\ndefault,"), std::string::npos);
  EXPECT_NE(table.find("\nproposed at 16 pixels,"), std::string::npos);
  EXPECT_EQ(table.find("\nmala,"), std::string::npos);
  arguments.back() = "proposed by an oracle";
  const Finished refused = run(arguments);
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("'mala'"), std::string::npos) << refused.err;
}

TEST_F(ChartCommand, RefusesWhatItCannotChartInOneSentence) {
  const auto refusal = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "chart");
    const Finished finished = run(arguments);
    EXPECT_EQ(finished.status, 2);
    return finished.err;
  };
  EXPECT_NE(refusal({"--out", path("x")}).find("--material"), std::string::npos);
  EXPECT_NE(refusal({"--material", "bump"}).find("--out"), std::string::npos);
  EXPECT_NE(refusal({"--material", "bump", "--out", path("x"), "--preset", "slow"}).find("quick"),
            std::string::npos);
  EXPECT_NE(refusal({"--material", "bump", "--out", path("x"), "--repeats", "0"}).find("--repeats"),
            std::string::npos);
  EXPECT_NE(refusal({path("none.png"), "--material", "bump", "--out", path("x")}).find("none.png"),
            std::string::npos);
}

}  // namespace
}  // namespace patina
