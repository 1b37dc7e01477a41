#include <random>

#include "tests/cli/cli_fixture.h"

namespace patina {
namespace {

class Resume : public CliTest {
 protected:
  static std::vector<std::string> with(std::vector<std::string> arguments,
                                       const std::vector<std::string>& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  std::string chains(const std::string& name) const {
    return slurp(folder_ / name / "chain-1.csv") + slurp(folder_ / name / "chain-2.csv");
  }
};

TEST_F(Resume, AFitThatIsKilledAgainAndAgainEndsInTheVeryFilesOfTheUndisturbedOne) {
  const std::string photo = this->photo();
  const auto start = std::chrono::steady_clock::now();
  output(small_fit(photo, "undisturbed"));
  const auto whole = std::chrono::steady_clock::now() - start;
  const auto again = with(small_fit(photo, "killed"), {"--resume"});
  std::mt19937 random(3);
  const std::filesystem::path kept[] = {path("killed/mode.state"), path("killed/warmup.state")};
  int kills = 0;
  for (; kills < 12 && chains("killed") != chains("undisturbed"); ++kills) {
    CliProcess fit(again, folder_);
    // As soon as something is kept, then later and later.
    if (kills < 2)
      EXPECT_TRUE(comes_true([&] { return std::filesystem::exists(kept[kills]); })) << fit.err();
    else
      std::this_thread::sleep_for(whole * (random() % 60 + 6 * kills) / 100);
    fit.signal(kills % 3 == 2 ? SIGINT : SIGKILL);
    fit.wait();
  }
  output(again);  // however slow the machine has become since
  EXPECT_EQ(chains("killed"), chains("undisturbed"));
  EXPECT_GE(kills, 3);
  EXPECT_EQ(json({"summarize", path("killed"), "--json"})["draws"], 60);
}

TEST_F(Resume, AFinishedFitGoesOnForMoreDrawsAsIfTheyHadBeenAskedForAtFirst) {
  const std::string photo = this->photo();
  output(small_fit(photo, "grown"));
  const std::vector<std::string> more{"fit", photo, "--out", path("grown"), "--resume", "--draws", "50"};
  EXPECT_EQ(json(with(more, {"--json"}))["summary"]["draws"], 100);
  auto at_once = small_fit(photo, "at once");
  *std::ranges::find(at_once, "30") = "50";
  output(at_once);
  EXPECT_EQ(chains("grown"), chains("at once"));

  output(more);  // nothing is left to do
  EXPECT_EQ(chains("grown"), chains("at once"));
}

TEST_F(Resume, ACroppedFitGoesOnWithItsCropWhichAnUncroppedOneMustNotHave) {
  const std::string photo = this->photo();
  output(with(small_fit(photo, "cropped"), {"--crop", "3,7,40"}));
  const nlohmann::json crop = nlohmann::json::parse(slurp(folder_ / "cropped" / "run.json"))["photo"]["crop"];
  EXPECT_EQ(crop, (nlohmann::json{{"x", 3}, {"y", 7}, {"side", 40}}));
  const std::vector<std::string> more{"fit", photo, "--out", path("cropped"), "--resume", "--draws", "50"};
  EXPECT_EQ(json(with(more, {"--json"}))["summary"]["draws"], 100);
  const Finished other = run(with(more, {"--crop", "4,7,40"}));
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.err.find("photo/crop/x"), std::string::npos) << other.err;
  EXPECT_EQ(run(with(small_fit(photo, "bad"), {"--crop", "3,7"})).status, 2);
  EXPECT_EQ(run(with(small_fit(photo, "bad"), {"--crop", "20,7,40"})).status, 2);
}

TEST_F(Resume, WithAnotherSettingPhotoOrFewerDrawsIsRefusedAndChangesNothing) {
  const std::string photo = this->photo();
  output(small_fit(photo, "run"));
  const std::string before = chains("run");
  const auto refusal = [&](const std::string& photo, const std::vector<std::string>& more) {
    const Finished finished = run(with({"fit", photo, "--out", path("run"), "--resume"}, more));
    EXPECT_EQ(finished.status, 2) << finished.err;
    return finished.err;
  };
  EXPECT_NE(refusal(photo, {"--kernel", "nuts"}).find("settings/kernel (\"auto\", not \"nuts\")"),
            std::string::npos);
  EXPECT_NE(refusal(photo, {"--temper", "3"}).find("settings/temper (0, not 3)"), std::string::npos);
  EXPECT_NE(refusal(photo, {"--seed", "2"}).find("settings/seed"), std::string::npos);
  EXPECT_NE(refusal(photo, {"--fix", "rough=0.4"}).find("settings/fixed"), std::string::npos);
  EXPECT_NE(refusal(photo, {"--draws", "20"}).find("as many or more"), std::string::npos);
  output({"render", "--material", "bump", "--resolution", "48", "--out", path("other.png")});
  EXPECT_NE(refusal(path("other.png"), {}).find("photo/sha256"), std::string::npos);
  EXPECT_EQ(chains("run"), before);
  EXPECT_EQ(json({"summarize", path("run"), "--json"})["phase"], "finished");
}

}  // namespace
}  // namespace patina
