#include <sys/resource.h>

#include <algorithm>
#include <sstream>

#include "engine/io/image_file.h"
#include "tests/cli/cli_fixture.h"

namespace patina {
namespace {

class Commands : public CliTest {};

TEST_F(Commands, HelpAndVersionSucceedOnStdout) {
  EXPECT_NE(output({"--help"}).find("summarize"), std::string::npos);
  EXPECT_NE(output({"fit", "--help"}).find("--map-only"), std::string::npos);
  EXPECT_EQ(output({"--version"}).substr(0, 7), "patina ");
}

TEST_F(Commands, MaterialsDescribeEveryParameterInBothForms) {
  const auto all = json({"materials", "--json"});
  ASSERT_GE(all["materials"].size(), 2u);
  for (const auto& material : all["materials"]) {
    const std::string name = material["name"];
    EXPECT_EQ(json({"materials", name, "--json"}), material);
    const std::string text = output({"materials", name});
    for (const char* kind : {"continuous", "discrete"})
      for (const auto& parameter : material[kind])
        EXPECT_NE(text.find(parameter["name"].get<std::string>()), std::string::npos) << parameter["name"];
  }
}

TEST_F(Commands, RenderTakesParamsThenSetsAndBothCurves) {
  const auto render = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"render", "--material", "bump",       "--resolution",
                                       "32",     "--out",      path("x.png")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    output(arguments);
    return read_image(path("x.png")).pixels;
  };
  const std::string params = file("p.json", "{\"rough\": 0.3, \"albedo_r\": 0.9}").string();
  const auto both = render({"--params", params, "--set", "rough=0.5"});
  EXPECT_EQ(both, render({"--set", "albedo_r=0.9", "--set", "rough=0.5"}));
  EXPECT_NE(both, render({"--params", params}));
  EXPECT_NE(render({"--curve", "gamma22"}), render({"--curve", "srgb"}));
  EXPECT_NE(render({"--z-seed", "5"}), render({"--z-seed", "6"}));
  EXPECT_NE(render({"--size-cm", "10"}), render({}));
}

TEST_F(Commands, RenderTakesValuesBeyondAPriorOnlyWithAWiderOne) {
  const std::string params = file("p.json", "{\"fsigma\": 15}").string();
  const std::vector<std::string> render{"render", "--material",  "bump",     "--resolution", "32",
                                        "--out",  path("x.png"), "--params", params};
  EXPECT_NE(run(render).err.find("out of range"), std::string::npos);
  std::vector<std::string> wider = render;
  wider.insert(wider.end(), {"--prior", "fsigma=5,2,0,20"});
  output(wider);
}

TEST_F(Commands, PredictWritesParametersThatRenderAndFitTake) {
  const auto predicted =
      json({"predict", photo(), "--material", "bump", "--out", path("guess.json"), "--json"});
  const auto written = nlohmann::json::parse(slurp(path("guess.json")));
  for (const auto& [name, value] : written.items())
    EXPECT_NEAR(value, predicted["parameters"][name]["value"].get<double>(), 1e-9) << name;
  EXPECT_GT(predicted["parameters"]["rough"]["sd"], 0);
  output({"render", "--material", "bump", "--params", path("guess.json"), "--resolution", "32", "--out",
          path("guess.png")});
  std::vector<std::string> fit = small_fit(photo(), "run");
  fit.insert(fit.end(), {"--start", path("guess.json")});
  output(fit);
  EXPECT_NE(output({"predict", photo(), "--material", "bump"}).find("rough"), std::string::npos);
}

TEST_F(Commands, AFitThatIsToldNothingOfItsLengthSaysHowFarItIs) {
  const Finished finished =
      run({"fit", photo(), "--material", "bump", "--summary", "means", "--resolution", "32", "--kernel",
           "hmc", "--ess", "20", "--rhat", "0", "--out", path("run")});
  EXPECT_EQ(finished.status, 0) << finished.err;
  EXPECT_NE(finished.err.find("warming up, "), std::string::npos) << finished.err;
  EXPECT_NE(finished.err.find("at most "), std::string::npos) << finished.err;
}

TEST_F(Commands, AFitsJsonAgreesWithItsSummaryAndItsExports) {
  std::vector<std::string> arguments = small_fit(photo(), "run");
  arguments.push_back("--json");
  const auto fit = json(arguments);
  EXPECT_EQ(fit["directory"], path("run"));
  EXPECT_EQ(fit["summary"], json({"summarize", path("run"), "--json"}));
  EXPECT_EQ(fit["summary"]["draws"], 60);
  EXPECT_EQ(fit["summary"]["phase"], "finished");
  EXPECT_TRUE(fit["summary"]["parameters"]["rough"]["rhat"].is_number());

  output({"export", path("run"), "--draw", "map", "--format", "json", "--out", path("map.json")});
  EXPECT_EQ(nlohmann::json::parse(slurp(path("map.json"))), fit["map"]);
  output({"export", path("run"), "--draw", "mean", "--format", "json", "--out", path("mean.json")});
  const auto mean = nlohmann::json::parse(slurp(path("mean.json")));
  for (const auto& [name, value] : mean.items())
    EXPECT_NEAR(value, fit["summary"]["parameters"][name]["mean"].get<double>(), 1e-9) << name;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

TEST_F(Commands, ANumberedDrawIsThatRowOfItsChainFileAndOfTheTable) {
  output(small_fit(photo(), "run"));
  output({"export", path("run"), "--draw", "2:50", "--format", "json", "--out", path("draw.json")});
  output({"export", path("run"), "--format", "csv", "--out", path("draws.csv")});
  std::string of_draw;
  const auto draw = nlohmann::ordered_json::parse(slurp(path("draw.json")));
  for (const auto& [name, value] : draw.items()) of_draw += name + "=" + value.dump() + " ";

  std::ifstream chain(path("run/chain-2.csv"));
  std::vector<std::vector<std::string>> rows;  // the first one holds the names
  for (std::string line; std::getline(chain, line);)
    if (line[0] != '#') rows.push_back(cells_of(line));
  std::string of_row;
  for (std::size_t i = 7; i < rows[0].size(); ++i)
    of_row += rows[0][i] + "=" + nlohmann::json(std::stod(rows[50][i])).dump() + " ";
  EXPECT_EQ(of_draw, of_row);

  std::ifstream table(path("draws.csv"));
  int lines = 0;
  std::string of_table;
  for (std::string line; std::getline(table, line); ++lines)
    if (line.starts_with("2,50,")) {
      const auto cells = cells_of(line);
      for (std::size_t i = 3; i < cells.size(); ++i)
        of_table += rows[0][i + 4] + "=" + nlohmann::json(std::stod(cells[i])).dump() + " ";
    }
  EXPECT_EQ(of_table, of_row);
  EXPECT_EQ(lines, 1 + 2 * 30);
}

TEST_F(Commands, MapsAreWrittenAtTheAskedResolution) {
  output(small_fit(photo(), "run"));
  output({"export", path("run"), "--draw", "1:41", "--format", "maps", "--resolution", "64", "--out",
          path("maps")});
  for (const char* name : {"render.png", "base_color.png", "normal_gl.png", "roughness.png", "height.png"})
    EXPECT_EQ(read_image(folder_ / "maps" / name).width, 64) << name;
  const auto rendered = [&](const std::string& params) {
    output({"render", "--material", "bump", "--params", params, "--resolution", "64", "--out",
            path("again.png")});
    return slurp(path("again.png"));
  };
  EXPECT_EQ(rendered(path("maps/params.json")), slurp(path("maps/render.png")));
}

TEST_F(Commands, FixedAndReplacedPriorsHold) {
  std::vector<std::string> arguments = small_fit(photo(), "run");
  for (const char* more :
       {"--fix", "light=1200", "--fix", "iSigma=10", "--prior", "rough=0.4,0.1,0.35,0.45", "--json"})
    arguments.push_back(more);
  const auto parameters = json(arguments)["summary"]["parameters"];
  EXPECT_EQ(parameters["light"]["mean"], 1200);
  EXPECT_EQ(parameters["light"]["sd"], 0);
  EXPECT_TRUE(parameters["light"]["rhat"].is_null());
  EXPECT_GE(parameters["rough"]["q5"], 0.35);
  EXPECT_LE(parameters["rough"]["q95"], 0.45);
}

TEST_F(Commands, QuietSaysNothing) {
  std::vector<std::string> arguments = small_fit(photo(), "run");
  arguments.push_back("--quiet");
  const Finished finished = run(arguments);
  EXPECT_EQ(finished.status, 0);
  EXPECT_EQ(finished.out + finished.err, "");
}

TEST_F(Commands, AnInterruptedFitKeepsItsDrawsAndSucceeds) {
  std::vector<std::string> arguments = small_fit(photo(), "run");
  *(std::ranges::find(arguments, "--draws") + 1) = "1000000";
  for (const int signal : {SIGINT, SIGTERM}) {
    arguments.back() = path("run" + std::to_string(signal));
    CliProcess fit(arguments, folder_);
    const std::string chain = arguments.back() + "/chain-1.csv";
    ASSERT_TRUE(comes_true([&] { return slurp(chain).find("Adaptation terminated") != std::string::npos; }));
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    fit.signal(signal);
    const Finished finished = fit.wait();
    EXPECT_EQ(finished.status, 0) << finished.err;
    EXPECT_NE(finished.err.find("stopped"), std::string::npos) << finished.err;
    const auto summary = json({"summarize", arguments.back(), "--json"});
    EXPECT_EQ(summary["phase"], "stopped");
    EXPECT_GT(summary["draws"], 0);
  }
}

TEST_F(Commands, AFullDiskPausesTheFitWhichGoesOnWhenThereIsRoom) {
  std::vector<std::string> arguments = small_fit(photo(), "run");
  *(std::ranges::find(arguments, "--draws") + 1) = "600";
  arguments.insert(arguments.end(), {"--ess", "0", "--rhat", "0"});  // none of them is too many
  CliProcess fit(arguments, folder_);
  ASSERT_TRUE(comes_true([&] { return std::filesystem::exists(path("run/chain-2.csv")); }));
  const rlimit little{20'000, RLIM_INFINITY}, plenty{RLIM_INFINITY, RLIM_INFINITY};
  ASSERT_EQ(::prlimit(fit.id(), RLIMIT_FSIZE, &little, nullptr), 0);
  EXPECT_TRUE(comes_true([&] { return fit.err().find("disk is full") != std::string::npos; }));
  ASSERT_EQ(::prlimit(fit.id(), RLIMIT_FSIZE, &plenty, nullptr), 0);
  const Finished finished = fit.wait();
  EXPECT_EQ(finished.status, 0) << finished.err;
  EXPECT_EQ(json({"summarize", path("run"), "--json"})["draws"], 1200);
}

TEST_F(Commands, ABestMatchAloneIsLookedForAtMorePixels) {
  std::vector<std::string> fit{"fit",   photo(), "--material", "translucent",  "--summary",  "means",
                               "--fix", "g=0.5", "--fix",      "sigma_a=0.02", "--map-only", "--out"};
  const auto resolution_of = [&](const std::string& name) {
    fit.push_back(path(name));
    output(fit);
    fit.pop_back();
    return nlohmann::json::parse(slurp(path(name + "/run.json")))["settings"]["resolution"].get<int>();
  };
  EXPECT_EQ(resolution_of("fine"), 256);
  fit.insert(fit.begin() + 2, {"--resolution", "32"});
  EXPECT_EQ(resolution_of("coarse"), 32);
}

}  // namespace
}  // namespace patina
