#include <algorithm>

#include "tests/cli/cli_fixture.h"

namespace patina {
namespace {

/// Exit status 2 and exactly one line on stderr, which mentions what is wrong; nothing on stdout.
class BadInput : public CliTest {
 protected:
  void refused(const std::vector<std::string>& arguments, const std::string& mentions) const {
    const Finished finished = run(arguments);
    std::string command;
    for (const std::string& argument : arguments) command += " " + argument;
    EXPECT_EQ(finished.status, 2) << command << "\n" << finished.err;
    EXPECT_EQ(std::ranges::count(finished.err, '\n'), 1) << command << "\n" << finished.err;
    EXPECT_NE(finished.err.find(mentions), std::string::npos) << command << "\n" << finished.err;
    EXPECT_EQ(finished.out, "") << command;
  }

  std::vector<std::string> fit(const std::string& photo, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"fit", photo, "--material", "bump", "--out", path("run")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
};

TEST_F(BadInput, Usage) {
  refused({}, "fit, predict");
  refused({"nosuch"}, "command");
  refused({"fit"}, "PHOTO");
  refused({"summarize"}, "RUN_DIR");
  refused({"render", "--material", "bump"}, "--out");
}

TEST_F(BadInput, Photos) {
  const std::string good = photo();
  const std::string bytes = slurp(good);
  refused(fit(path("missing.jpg"), {}), "missing.jpg");
  refused(fit(file("text.jpg", "not an image").string(), {}), "text.jpg");
  refused(fit(file("empty.png", "").string(), {}), "empty.png");
  refused(fit(file("cut.png", bytes.substr(0, bytes.size() / 2)).string(), {}), "cut.png");
  refused(fit(folder_.string(), {}), "");
}

TEST_F(BadInput, SettingsOfAFit) {
  const std::string good = photo();
  refused({"fit", good, "--out", path("run")}, "--material");
  refused({"fit", good, "--material", "nosuch", "--out", path("run")}, "nosuch");
  refused(fit(good, {"--draws", "-5"}), "-5");
  refused(fit(good, {"--draws", "many"}), "--draws");
  refused(fit(good, {"--network", good}), "");
  refused(fit(good, {"--network", file("cut.pth", "PK\3\4").string()}), "zip archive");
  refused(fit(good, {"--network", file("shell.pth", "\x80\x02\x8a\x0a").string()}), "pickle");
  refused(fit(good, {"--summary", "gram,rings"}), "gram, covariances, rings, bands, means");
  refused(fit(good, {"--size-cm", "nan"}), "cm");
  refused(fit(good, {"--seed", "-1"}), "--seed");
  EXPECT_FALSE(std::filesystem::exists(path("run")));
}

TEST_F(BadInput, FixedValuesAndPriors) {
  const std::string good = photo();
  refused(fit(good, {"--fix", "rough=high"}), "--fix");
  refused(fit(good, {"--fix", "nosuch=1"}), "nosuch");
  refused(fit(good, {"--prior", "rough=1,2"}), "--prior");
  refused(fit(good, {"--prior", "rough=0.4,0.1,0.6,"}), "--prior");
}

TEST_F(BadInput, Renders) {
  const auto render = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"render", "--material", "bump", "--out", path("x.png")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  refused(render({"--params", file("p1.json", "{\"light\": \"many\"}").string()}), "light");
  refused(render({"--params", file("p2.json", "{\"nosuch\": 1}").string()}), "nosuch");
  refused(render({"--params", file("p3.json", "{").string()}), "p3.json");
  refused(render({"--params", file("p4.json", "{\"light\": 1e99}").string()}), "light");
  refused(render({"--params", path("missing.json")}), "missing.json");
  refused(render({"--set", "rough"}), "--set");
  refused(render({"--resolution", "0"}), "resolution");
  refused(render({"--curve", "nosuch"}), "--curve");
  refused({"render", "--material", "nosuch", "--out", path("x.png")}, "nosuch");
  refused({"render", "--material", "bump", "--out", path("x.nosuch")}, "x.nosuch");
  refused({"render", "--material", "bump", "--out", path("no/such/x.png")}, "x.png");
  refused({"materials", "nosuch"}, "nosuch");
}

TEST_F(BadInput, RunDirectories) {
  std::filesystem::create_directory(path("empty"));
  refused({"summarize", path("empty")}, "run.json");
  refused({"summarize", path("nowhere")}, "nowhere");
  refused({"export", path("empty"), "--draw", "map", "--format", "json", "--out", path("x")}, "run.json");
  output(small_fit(photo(), "run"));
  refused(small_fit(photo(), "run"), "holds a run already");
  const auto exported = [&](const std::string& draw, const std::string& format, const std::string& out) {
    return std::vector<std::string>{"export", path("run"), "--draw", draw, "--format", format, "--out", out};
  };
  refused(exported("3:1", "json", path("x")), "3:1");
  refused(exported("1:71", "json", path("x")), "1:71");
  refused(exported("map", "nosuch", path("x")), "--format");
  refused(exported("map", "maps", photo()), "folder");
  std::vector<std::string> tile_of_numbers = exported("map", "json", path("x"));
  tile_of_numbers.push_back("--tile");
  refused(tile_of_numbers, "--tile");
  file("run/run.json", slurp(path("run/run.json")).substr(0, 300));
  refused({"summarize", path("run")}, "run.json");
}

TEST_F(BadInput, ARunWithoutDrawsCannotBeSummarised) {
  std::vector<std::string> map_only = small_fit(photo(), "run");
  map_only.push_back("--map-only");
  output(map_only);
  refused({"summarize", path("run")}, "no draws");
}

}  // namespace
}  // namespace patina
