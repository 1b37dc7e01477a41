#include "tests/cli/cli_fixture.h"

namespace patina {
namespace {

class Freeze : public CliTest {};

TEST_F(Freeze, ANewRunHoldsWhatTheOldOnesPhotoDoesNotPinDown) {
  const std::string photo = this->photo();
  // Mean colours say nothing of how fine bumps are.
  std::vector<std::string> first = small_fit(photo, "first");
  for (std::string& argument : first)
    if (argument == "30") argument = "1000";
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

}  // namespace
}  // namespace patina
