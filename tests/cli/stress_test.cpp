#include <algorithm>
#include <fstream>
#include <vector>

#include "tests/cli/cli_fixture.h"

namespace patina {
namespace {

class StressTest : public CliTest {};

TEST_F(StressTest, TriesOneScenarioWithTheNamedKernelsAndPrintsOneDocument) {
  const nlohmann::json document =
      json({"stress", "--scenario", "three draws", "--kernel", "mh", "hmc", "--json"});
  ASSERT_EQ(document["cells"].size(), 2u);
  for (const nlohmann::json& cell : document["cells"]) {
    EXPECT_EQ(cell["scenario"], "three draws");
    EXPECT_EQ(cell["outcome"], "alarmed");
  }
  EXPECT_EQ(document["cells"][1]["kernel"], "hmc");
}

TEST_F(StressTest, PutsItsTableIntoAPage) {
  std::ofstream(path("page.md")) << "# Kept\n<!-- patina-cli stress -->\n<!-- /patina-cli stress -->\n";
  EXPECT_EQ(output({"stress", "--scenario", "one draw", "--kernel", "hmc", "--out", path("page.md")}), "");
  const std::string page = slurp(path("page.md"));
  EXPECT_EQ(page.find("# Kept"), 0u);
  EXPECT_NE(page.find("| **one draw**"), std::string::npos) << page;
}

TEST_F(StressTest, RefusesWhatItDoesNotKnowWithOneSentence) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--scenario", "nothing"},
                                                {"--material", "nothing"},
                                                {"--kernel", "nothing"},
                                                {"--kernel", "auto"},
                                                {"--threads", "0"}}) {
    std::vector<std::string> arguments{"stress"};
    arguments.insert(arguments.end(), words.begin(), words.end());
    const Finished finished = run(arguments);
    EXPECT_EQ(finished.status, 2) << words.front();
    EXPECT_EQ(std::ranges::count(finished.err, '\n'), 1) << finished.err;
  }
}

TEST_F(StressTest, WhatARunSaysAgainstItselfStandsInItsSummary) {
  std::ofstream(path("grey.pgm"), std::ios::binary) << "P5 48 48 255\n" << std::string(48 * 48, '\x80');
  output(small_fit(path("grey.pgm"), "run"));
  EXPECT_NE(output({"summarize", path("run")}).find("\nMind: Every pixel of the photo is the same"),
            std::string::npos);
  EXPECT_EQ(json({"summarize", path("run"), "--json"})["alarms"][0]["name"], "blank");
}

}  // namespace
}  // namespace patina
