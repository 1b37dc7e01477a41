#include "tests/cli/cli_fixture.h"

namespace patina {
namespace {

/// Comparisons of two materials by mean colours, at few pixels.
class Compare : public CliTest {
 protected:
  std::vector<std::string> quick() const {
    return {"compare",      photo(), "--search",    "--materials", "translucent,bump", "--summary", "means",
            "--resolution", "32",    "--finalists", "0",           "--quiet"};
  }
};

TEST_F(Compare, RanksInBothFormsAlike) {
  std::vector<std::string> arguments = quick();
  const std::string text = output(arguments);
  arguments.push_back("--json");
  const auto json = this->json(arguments);
  ASSERT_EQ(json["materials"].size(), 2u);
  EXPECT_EQ(json["summary"], "means");
  double total = 0;
  for (const auto& material : json["materials"]) {
    EXPECT_NE(text.find("\n" + material["material"].get<std::string>() + " "), std::string::npos);
    EXPECT_TRUE(material["error"].is_null());
    EXPECT_FALSE(material["match"].empty());
    total += material["probability"].get<double>();
  }
  EXPECT_NEAR(total, 1, 1e-12);
  EXPECT_NE(text.find(json["sentence"].get<std::string>()), std::string::npos);
}

TEST_F(Compare, GlancesUnlessASearchIsAskedFor) {
  const auto glance = json({"compare", photo(), "--json", "--quiet"});
  EXPECT_EQ(glance["summary"], "glance");
  EXPECT_GT(glance["materials"].size(), 2u);
  EXPECT_TRUE(glance["materials"][0]["misfit"].is_null());
  const Finished searched = run({"compare", photo(), "--finalists", "2"});
  EXPECT_EQ(searched.status, 2) << "what only a search heeds";
  EXPECT_NE(searched.err.find("--search"), std::string::npos) << searched.err;
}

TEST_F(Compare, RefusesWithTheReasonAndStatusTwo) {
  std::vector<std::string> arguments = quick();
  arguments[4] = "bump,cheese";
  for (const auto& asked :
       {arguments, std::vector<std::string>{"compare", photo(), "--materials", "cheese"}}) {
    const Finished unknown = run(asked);
    EXPECT_EQ(unknown.status, 2);
    EXPECT_NE(unknown.err.find("cheese"), std::string::npos) << unknown.err;
  }
  EXPECT_EQ(run({"compare", path("absent.png")}).status, 2);
  EXPECT_EQ(run({"render", "--material", "auto", "--out", path("x.png")}).status, 2) << "fit alone chooses";
}

}  // namespace
}  // namespace patina
