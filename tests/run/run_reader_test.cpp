#include <algorithm>

#include "engine/io/file.h"
#include "engine/run/manifest.h"
#include "engine/run/run_files.h"
#include "tests/run/run_fixture.h"

namespace patina {
namespace {

class OpenRun : public RunTest {
 protected:
  /// A finished run to damage.
  void make_run() const { draws_to_the_end(*start(settings())); }

  std::string refusal() const {
    return user_error([&] { open_run(directory())->take_draws(); });
  }

  std::string photo_file() const {
    const std::filesystem::path name = folder_ / "photo.png";
    return run_cli_render(name), name.string();
  }

  /// Reads until a condition on (run, draws so far) holds.
  template <typename Condition>
  static bool reads_until(DrawSource& run, std::vector<Draw>& draws, Condition condition) {
    return comes_true([&] {
      for (Draw& draw : run.take_draws()) draws.push_back(std::move(draw));
      return condition();
    });
  }

 private:
  void run_cli_render(const std::filesystem::path& name) const {
    CliProcess render({"render", "--material", "bump", "--resolution", "48", "--out", name.string()},
                      folder_);
    ASSERT_EQ(render.wait().status, 0);
  }
};

/// patina-cli fit without end.
std::vector<std::string> endless_fit(const std::string& photo, const std::filesystem::path& directory) {
  return {"fit",          photo,     "--material", "bump",  "--summary",       "means",
          "--resolution", "32",      "--chains",   "2",     "--warmup",        "40",
          "--draws",      "1000000", "--quiet",    "--out", directory.string()};
}

TEST_F(OpenRun, KnowsWhichParametersAreJagged) {
  RunSettings asked = settings();
  asked.material = "leather";
  const auto made = start(asked);
  draws_to_the_end(*made);
  const auto read = open_run(directory());
  ASSERT_EQ(read->table().continuous.size(), made->table().continuous.size());
  int jagged = 0;
  for (std::size_t i = 0; i < made->table().continuous.size(); ++i) {
    EXPECT_EQ(read->table().continuous[i].jagged, made->table().continuous[i].jagged);
    EXPECT_EQ(read->table().continuous[i].place, made->table().continuous[i].place);
    jagged += made->table().continuous[i].jagged;
  }
  EXPECT_GT(jagged, 0);
}

TEST_F(OpenRun, ReadsBackAllThatAFinishedRunIs) {
  RunSettings asked = settings();
  asked.fixed["iSigma"] = 12;
  asked.priors["rough"] = {0.3, 0.1, 0.2, 0.6};
  asked.capture = {10, 20};
  asked.z_seed = 0xffffffffffffffffu;
  const auto made = start(asked);
  const std::vector<Draw> draws = draws_to_the_end(*made);
  const auto read = open_run(directory());
  const std::vector<Draw> read_draws = read->take_draws();

  EXPECT_EQ(read->settings().material, "bump");
  EXPECT_EQ(read->settings().capture, asked.capture);
  EXPECT_EQ(read->settings().z_seed, asked.z_seed);
  EXPECT_EQ(read->settings().fixed, asked.fixed);
  EXPECT_EQ(read->settings().priors, asked.priors);
  EXPECT_EQ(read->settings().warmup, asked.warmup);
  EXPECT_EQ(read->table().continuous.size(), made->table().continuous.size());
  EXPECT_EQ(read->table().continuous[4].prior, asked.priors["rough"]);
  ASSERT_EQ(read->photo().pixels.size(), made->photo().pixels.size());
  for (std::size_t i = 0; i < read->photo().pixels.size(); ++i)
    ASSERT_NEAR(read->photo().pixels[i], made->photo().pixels[i], 1.0 / 65535);
  EXPECT_FALSE(read->can_control());

  ASSERT_EQ(read_draws.size(), draws.size());
  for (const Draw& draw : draws) {
    const auto same = std::ranges::find_if(read_draws, [&](const Draw& other) {
      return other.chain == draw.chain && other.iteration == draw.iteration;
    });
    ASSERT_NE(same, read_draws.end());
    EXPECT_EQ(same->values, draw.values);
    EXPECT_EQ(same->lp, draw.lp);
    EXPECT_EQ(same->warmup, draw.warmup);
    EXPECT_EQ(same->accept_stat, draw.accept_stat);
  }
  const RunStatus status = read->status();
  EXPECT_EQ(status.phase, RunPhase::finished);
  EXPECT_EQ(status.message, made->status().message);
  EXPECT_EQ(status.best, made->status().best);
  EXPECT_EQ(status.best_lp, made->status().best_lp);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_DOUBLE_EQ(status.chains[k].acceptance, made->status().chains[k].acceptance);
    EXPECT_EQ(status.chains[k].iteration, 70);
  }
}

TEST_F(OpenRun, ComesInPortionsWithoutPauseToThoseWhoAskForThem) {
  RunSettings asked = settings();
  asked.draws = 3000;
  draws_to_the_end(*start(asked));
  const auto run = open_run(directory(), 100);
  std::vector<Draw> draws = run->take_draws();
  EXPECT_LT(draws.size(), 2u * (40 + 3000)) << "a few hundred lines of each chain";
  EXPECT_GT(run->status().read_fraction, 0);
  EXPECT_LT(run->status().read_fraction, 1);
  int looks = 0;
  for (; run->status().read_fraction < 1; ++looks)
    for (Draw& draw : run->take_draws()) draws.push_back(std::move(draw));
  EXPECT_LE(looks, 2 * (40 + 3000) / 100 + 1) << "one that is told to wait comes back empty-handed";
  EXPECT_EQ(draws.size(), 2u * (40 + 3000));
}

TEST_F(OpenRun, FollowsARunOfAnotherProcessAndKeepsEveryWholeRowAfterItIsKilled) {
  CliProcess fit(endless_fit(photo_file(), directory()), folder_);
  ASSERT_TRUE(comes_true([&] { return std::filesystem::exists(directory() / "run.json"); }));
  const auto run = open_run(directory());
  EXPECT_NE(run->status().phase, RunPhase::stopped);
  std::vector<Draw> draws;
  ASSERT_TRUE(reads_until(*run, draws, [&] { return run->status().phase == RunPhase::sampling; }));
  const std::size_t before = draws.size();
  ASSERT_TRUE(reads_until(*run, draws, [&] { return draws.size() > before + 100; }));
  EXPECT_TRUE(run->status().best);

  fit.signal(SIGKILL);
  EXPECT_EQ(fit.wait().status, -SIGKILL);
  ASSERT_TRUE(reads_until(*run, draws, [&] { return run->status().phase == RunPhase::stopped; }));
  EXPECT_NE(run->status().message.find("ended early"), std::string::npos) << run->status().message;
  std::vector<Draw> again = open_run(directory())->take_draws();
  EXPECT_EQ(again.size(), draws.size());
  std::size_t whole_rows = 0;
  for (const char* name : {"chain-1.csv", "chain-2.csv"}) {
    const std::string text = slurp(directory() / name);
    whole_rows += rows_of(directory() / name).size() - (text.back() != '\n');
  }
  EXPECT_EQ(draws.size(), whole_rows);
}

TEST_F(OpenRun, SeesARunOfItsOwnProcessGrowAndEnd) {
  const auto writer = start(endless());
  const auto reader = open_run(directory());
  std::vector<Draw> draws;
  ASSERT_TRUE(reads_until(*reader, draws, [&] { return reader->status().phase == RunPhase::sampling; }));
  writer->stop();
  EXPECT_TRUE(reads_until(*reader, draws, [&] { return reader->status().phase == RunPhase::stopped; }));
  EXPECT_EQ(reader->status().message, writer->status().message);
  EXPECT_EQ(draws.size(), writer->take_draws().size());
}

TEST_F(OpenRun, FollowsARunThatIsTakenUpAgainAfterItsEnd) {
  draws_to_the_end(*start(settings()));
  const auto reader = open_run(directory());
  EXPECT_EQ(reader->take_draws().size(), 2u * (40 + 30));
  EXPECT_EQ(reader->status().phase, RunPhase::finished);
  RunSettings longer = settings();
  longer.draws = 55;
  const auto again = resume_run(longer, photo(), directory());
  EXPECT_EQ(draws_to_the_end(*again).size(), 2u * (40 + 55));
  std::size_t more = 0;
  EXPECT_TRUE(comes_true([&] {
    more += reader->take_draws().size();
    return more == 2u * 25 && reader->status().phase == RunPhase::finished;
  })) << more;
  EXPECT_EQ(reader->settings().draws, 55);
}

TEST_F(OpenRun, ARunThatIsPutInItsPlaceMeanwhileIsNotTakenForIt) {
  draws_to_the_end(*start(settings()));
  Manifest manifest = read_manifest(directory());
  manifest.phase = RunPhase::sampling;
  write_file_atomically(manifest_file(directory()), to_json(manifest));
  const auto reader = open_run(directory());
  EXPECT_EQ(reader->take_draws().size(), 2u * (40 + 30));
  manifest.settings.chains = 5;
  write_file_atomically(manifest_file(directory()), to_json(manifest));
  std::string sentence;
  EXPECT_TRUE(comes_true([&] {
    sentence = user_error([&] { reader->take_draws(); });
    return !sentence.empty();
  }));
  EXPECT_NE(sentence.find("Another run"), std::string::npos) << sentence;
}

TEST_F(OpenRun, RefusesWhatIsNoRun) {
  EXPECT_NE(refusal().find("no run directory"), std::string::npos) << refusal();
  std::filesystem::create_directory(directory());
  EXPECT_NE(refusal().find("run.json"), std::string::npos) << refusal();
  std::filesystem::remove(directory());
  file("run", "a file");
  EXPECT_NE(refusal(), "");
}

TEST_F(OpenRun, RefusesARunThatANewerVersionMade) {
  make_run();
  std::string manifest = slurp(directory() / "run.json");
  manifest.replace(manifest.find("\"format\": 1"), 11, "\"format\": 2");
  file("run/run.json", manifest);
  EXPECT_NE(refusal().find("newer version"), std::string::npos) << refusal();
}

TEST_F(OpenRun, RefusesAHalfWrittenManifestAtEveryLength) {
  make_run();
  const std::string manifest = slurp(directory() / "run.json");
  for (std::size_t length = 0; length + 2 < manifest.size(); length += 97) {
    file("run/run.json", manifest.substr(0, length));
    ASSERT_NE(refusal(), "") << length;
  }
}

TEST_F(OpenRun, RefusesADirectoryWithoutItsPhoto) {
  make_run();
  std::filesystem::remove(directory() / "photo.png");
  EXPECT_NE(refusal().find("photo.png"), std::string::npos) << refusal();
}

TEST_F(OpenRun, RefusesAChainFileThatIsNone) {
  make_run();
  file("run/chain-1.csv", "lp__,accept_stat__\n1,2\n");
  EXPECT_NE(refusal().find("chain-1.csv"), std::string::npos) << refusal();
}

TEST_F(OpenRun, RefusesAChainFileOfAnotherMaterial) {
  make_run();
  std::string chain = slurp(directory() / "chain-1.csv");
  chain.replace(chain.find("rough"), 5, "fuzzy");
  file("run/chain-1.csv", chain);
  EXPECT_NE(refusal().find("chain-1.csv"), std::string::npos) << refusal();
}

TEST_F(OpenRun, TakesARowThatIsNotFinishedYetOnlyOnceItIs) {
  make_run();
  const std::string chain = slurp(directory() / "chain-1.csv");
  const std::size_t end = chain.find("\n#\n");
  file("run/chain-1.csv", chain.substr(0, end - 5));
  const std::size_t all = 2 * 70;
  EXPECT_EQ(open_run(directory())->take_draws().size(), all - 1);
  file("run/chain-1.csv", chain);
  EXPECT_EQ(open_run(directory())->take_draws().size(), all);
}

}  // namespace
}  // namespace patina
