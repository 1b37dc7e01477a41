#include "tests/cli/cli_fixture.h"

namespace patina {
namespace {

class Freeze : public CliTest {};

TEST_F(Freeze, ANewRunHoldsWhatTheOldOnesPhotoDoesNotPinDown) {
  const std::string photo = this->photo();
  // Mean colours say nothing of how fine bumps are. Where roughness is free, a short run now and then stays
  // most of its time at its floor, and says too little.
  std::vector<std::string> first = small_fit(photo, "first");
  for (std::string& argument : first)
    if (argument == "30") argument = "1000";
  first.insert(first.end(), {"--fix", "rough=0.4"});
  const auto before = json([&] {
    std::vector<std::string> with_json = first;
    with_json.push_back("--json");
    return with_json;
  }());
  const Finished second =
      run({"fit", photo, "--out", path("second"), "--freeze", path("first"), "--draws", "300", "--quiet"});
  ASSERT_EQ(second.status, 0) << second.err;
  const auto made = nlohmann::json::parse(slurp(path("second") + "/run.json"));
  std::size_t held = 0;
  for (const auto& advice : before["summary"]["advice"]) {
    const std::string name = advice["name"];
    if (advice["freeze_at"].is_null()) {
      EXPECT_FALSE(made["settings"]["fixed"].contains(name)) << name;
      continue;
    }
    ++held;
    EXPECT_EQ(made["settings"]["fixed"][name], advice["freeze_at"]) << name;
  }
  EXPECT_GT(held, 0u);
  EXPECT_EQ(made["settings"]["summary"], "means") << "all else is as it was";
}

TEST_F(Freeze, ARunThatNeedsAllItHasIsRefusedInOneSentence) {
  const std::string photo = this->photo();
  std::vector<std::string> fit = small_fit(photo, "first");
  output(fit);  // too few draws to say anything
  const Finished refused = run({"fit", photo, "--out", path("second"), "--freeze", path("first")});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("nothing that could be held"), std::string::npos) << refused.err;
}

TEST_F(Freeze, ANewRunLooksAtNoMoreOfThePictureThanIsNeeded) {
  const std::string photo = this->photo();
  std::vector<std::string> first = small_fit(photo, "first");
  for (std::string& argument : first) {
    if (argument == "30") argument = "1000";
    if (argument == "32") argument = "48";
  }
  // A flat surface has no grain that pixels could miss, and but for these all else is held.
  for (const char* held : {"fscale=0", "fsigma=5", "iSigma=15", "albedo_g=0.4", "albedo_b=0.4", "rough=0.4"})
    first.insert(first.end(), {"--fix", held});
  output(first);
  output({"fit", photo, "--out", path("second"), "--freeze", path("first"), "--picture", "--draws", "100",
          "--quiet"});
  const auto settings = nlohmann::json::parse(slurp(path("second") + "/run.json"))["settings"];
  EXPECT_EQ(settings["resolution"], 36);
  EXPECT_EQ(settings["summary"], "means");
}

TEST_F(Freeze, ASummarySaysWhenAskedHowMuchOfThePictureIsNeeded) {
  std::vector<std::string> fit = small_fit(photo(), "run");
  for (std::string& argument : fit) {
    if (argument == "30") argument = "200";
    if (argument == "32") argument = "48";
  }
  output(fit);
  EXPECT_FALSE(json({"summarize", path("run"), "--json"}).contains("picture")) << "it takes a while";
  const auto picture = json({"summarize", path("run"), "--json", "--picture"})["picture"];
  ASSERT_EQ(picture["tried"].size(), 1u) << "32 pixels are the fewest";
  EXPECT_EQ(picture["tried"][0]["resolution"], 36);
  EXPECT_GT(picture["tried"][0]["error"], 0);
  const std::string sentence = picture["sentence"];
  EXPECT_NE(sentence.find(picture["tried"][0]["agrees"] ? "--resolution 36" : "all of its 48 pixels"),
            std::string::npos)
      << sentence;
  const std::string advice = sentence.substr(sentence.rfind(": "));  // before it stands what was timed
  EXPECT_NE(output({"summarize", path("run"), "--picture"}).find(advice), std::string::npos) << sentence;
  const Finished refused = run({"fit", photo(), "--out", path("second"), "--picture"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("--freeze"), std::string::npos) << refused.err;
}

}  // namespace
}  // namespace patina
