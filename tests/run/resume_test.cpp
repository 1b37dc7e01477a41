#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <random>
#include <utility>

#include "engine/run/state_file.h"
#include "engine/run/threads.h"
#include "tests/run/cheap_chains.h"

namespace patina {
namespace {

class ResumeTest : public CheapChainsTest {
 protected:
  /// Takes up the run in a process of its own, which is killed, or else asked to stop, at its n-th
  /// evaluation.
  /// @return whether it came to its end
  bool take_up_until(int evaluation, bool kill, const std::filesystem::path& directory) {
    const int status = exit_status_of([&] {
      use_tensor_threads(1);  // libtorch mends its thread pool after a fork, but for one thread only
      RunShared shared({});
      std::atomic<int> evaluations{0};
      target_.before = [&] {
        if (++evaluations < evaluation) return;
        if (kill) ::raise(SIGKILL);
        shared.control.stop();
      };
      take_up(shared, directory);
      if (!shared.failure().empty()) std::fprintf(stderr, "%s\n", shared.failure().c_str());
      if (!shared.failure().empty()) return 2;
      return evaluations < evaluation ? 0 : 1;
    });
    EXPECT_TRUE(status == 0 || status == 1 || status == -SIGKILL) << status;
    return status == 0;
  }

  /// Takes up runs of other seeds again and again, until they have come to their end, and compares them with
  /// undisturbed ones.
  /// @return how often they were killed or stopped
  int interrupt_at_random(std::uint64_t seeds) {
    std::mt19937 random(7);
    int interruptions = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      settings_.seed = seed;
      const auto undisturbed = folder_ / ("a" + std::to_string(seed));
      const auto disturbed = folder_ / ("b" + std::to_string(seed));
      take_up(undisturbed);
      for (int tries = 0; tries < 500; ++tries) {
        const int evaluation = 1 + static_cast<int>(random() % 900);
        if (take_up_until(evaluation, random() % 3 > 0, disturbed)) break;
        ++interruptions;
      }
      EXPECT_EQ(bytes_of(disturbed), bytes_of(undisturbed)) << "seed " << seed;
    }
    return interruptions;
  }

  /// Takes up the run, stops it on the way and returns the state file of its first chain.
  std::filesystem::path stop_on_the_way(const std::filesystem::path& directory) {
    const std::filesystem::path file = chain_state_file(directory, 0);
    do take_up_until(500, /*kill=*/false, directory);  // its thread may be the last to begin
    while (!std::filesystem::exists(file));
    return file;
  }

  /// The finished chain of a run in whose state, after a stop on the way, something is changed; and of the
  /// undisturbed run.
  template <typename Change>
  std::pair<std::string, std::string> with_and_without(Change change) {
    take_up(folder_ / "a");
    const auto disturbed = folder_ / "b";
    const auto file = stop_on_the_way(disturbed);
    auto checkpoint = read_checkpoint(file, "key", target_, settings_);
    EXPECT_TRUE(checkpoint);
    if (!checkpoint) return {};
    change(*checkpoint);
    write_checkpoint(file, "key", *checkpoint);
    take_up(disturbed);
    return {slurp(chain_file(disturbed, 0)), slurp(chain_file(folder_ / "a", 0))};
  }
};

TEST_F(ResumeTest, KilledAndStoppedAtRandomTheFinishedChainsAreByteForByteTheUndisturbedOnes) {
  EXPECT_GT(interrupt_at_random(/*seeds=*/12), 40);
}

TEST_F(ResumeTest, SoAreThoseOfTemperedChains) {
  settings_.temper = 4;
  settings_.warmup = 150;
  EXPECT_GT(interrupt_at_random(/*seeds=*/3), 30);
}

TEST_F(ResumeTest, TheRunThatIsKilledIsOneThatLearnsAStraightening) {
  take_up(folder_);
  const WarmupRecord record = read_warmup(folder_, "key", target_, 1);
  EXPECT_TRUE(std::ranges::any_of(record, [](const auto& held) {
    return held.second.rungs.front().straightening != nullptr;
  })) << "or the tests here leave its state out";
}

TEST_F(ResumeTest, OneWordOfTheRandomStreamAsideTheFinishedChainsDiffer) {
  const auto [changed, undisturbed] = with_and_without([](ChainCheckpoint& c) { ++c.random_position; });
  EXPECT_NE(changed, undisturbed);
}

TEST_F(ResumeTest, OneRoundOfSwapsAsideTheFinishedTemperedChainsDiffer) {
  settings_.temper = 3;
  const auto [changed, undisturbed] = with_and_without([](ChainCheckpoint& c) { ++c.climber.state.rounds; });
  EXPECT_NE(changed, undisturbed);
}

TEST_F(ResumeTest, ARunThatIsTakenUpAgainHandsOutTheDrawsThatItHadToo) {
  const std::vector<Draw> at_once = take_up(folder_ / "a");
  take_up_until(700, /*kill=*/true, folder_ / "b");
  const std::vector<Draw> in_two = take_up(folder_ / "b");
  ASSERT_EQ(in_two.size(), at_once.size());
  EXPECT_EQ(take_up(folder_ / "b").size(), at_once.size()) << "a finished run has nothing to add";
}

TEST_F(ResumeTest, AFinishedRunThatGoesOnForMoreDrawsIsTheLongerRun) {
  const auto longer = folder_ / "long", shorter = folder_ / "short";
  take_up(shorter);
  settings_.draws = 200;
  take_up(shorter);
  take_up(longer);
  EXPECT_EQ(bytes_of(shorter), bytes_of(longer));
}

TEST_F(ResumeTest, AChainWithoutItsStateIsDrawnAnewToTheSameBytes) {
  take_up(folder_ / "a");
  take_up_until(900, /*kill=*/true, folder_ / "b");
  std::filesystem::remove(chain_state_file(folder_ / "b", 1));
  take_up(folder_ / "b");
  EXPECT_EQ(bytes_of(folder_ / "b"), bytes_of(folder_ / "a"));
}

TEST_F(ResumeTest, DamagedStatesAreRefusedWithASentenceAndNeverChangeADraw) {
  const auto directory = folder_ / "run";
  take_up(directory);
  const auto file = chain_state_file(directory, 1);
  const std::string state = slurp(file), draws = bytes_of(directory);
  std::mt19937 random(5);
  for (int i = 0; i < 200; ++i) {
    std::string damaged = state;
    if (i % 2 == 0)
      damaged.resize(random() % damaged.size());
    else
      damaged[random() % damaged.size()] ^= static_cast<char>(1 << random() % 8);
    this->file("run/chain-2.state", damaged);
    EXPECT_NE(user_error([&] { read_checkpoint(file, "key", target_, settings_); }), "") << i;
  }
  EXPECT_EQ(bytes_of(directory), draws);
}

TEST_F(ResumeTest, AForgedStateWithARightChecksumIsStillNotBelieved) {
  for (const int temper : {0, 3}) {
    settings_.temper = temper;
    const auto file = stop_on_the_way(folder_ / std::to_string(temper));
    const std::string state = slurp(file), payload = state.substr(state.find('\n') + 1);
    std::mt19937 random(5);
    for (int i = 0; i < 300; ++i) {
      std::string forged = payload;
      forged[random() % forged.size()] = static_cast<char>(random());
      if (i % 3 == 0) forged.resize(random() % forged.size());
      write_state(file, "key", forged);
      try {  // refused with a sentence, or a state that fits; never a crash
        read_checkpoint(file, "key", target_, settings_);
      } catch (const UserError& error) {
        EXPECT_NE(std::string(error.what()).find("cannot be used"), std::string::npos);
      }
    }
  }
}

TEST_F(ResumeTest, StatesOfAnotherLadderAreRefused) {
  settings_.temper = 4;
  take_up(folder_);
  const auto file = chain_state_file(folder_, 0);
  EXPECT_EQ(user_error([&] { read_checkpoint(file, "key", target_, settings_); }), "");
  const auto good = read_checkpoint(file, "key", target_, settings_);
  const auto refusal = [&](auto spoil) {
    ChainCheckpoint bad = *good;
    spoil(bad.climber);
    write_checkpoint(file, "key", bad);
    return user_error([&] { read_checkpoint(file, "key", target_, settings_); });
  };
  EXPECT_EQ(refusal([](Climber&) {}), "");
  EXPECT_NE(refusal([](Climber& c) { std::swap(c.betas[1], c.betas[2]); }), "");
  EXPECT_NE(refusal([](Climber& c) { c.betas[1] = 0; }), "") << "nothing can be divided by it";
  EXPECT_NE(refusal([](Climber& c) { c.betas.pop_back(); }), "");
  EXPECT_NE(refusal([](Climber& c) { c.state.rungs.pop_back(); }), "");
  EXPECT_NE(refusal([](Climber& c) { c.state.rungs[2].evaluation.log_density = NAN; }), "");
  EXPECT_NE(refusal([](Climber& c) { c.state.traveller[1] = 7; }), "");
  EXPECT_NE(refusal([](Climber& c) { c.state.from_prior.pop_back(); }), "");
  EXPECT_NE(refusal([](Climber& c) { c.warmups.pop_back(); }), "");
  EXPECT_NE(refusal([](Climber& c) { c.swaps = SwapRecord(3); }), "");
  settings_.temper = 0;
  EXPECT_NE(user_error([&] { read_checkpoint(file, "key", target_, settings_); }), "");
  EXPECT_NE(user_error([&] { read_warmup(folder_, "key", target_, 1); }), "");
  EXPECT_EQ(user_error([&] { read_warmup(folder_, "key", target_, 4); }), "");
}

TEST_F(ResumeTest, AStateOfAnotherRunAnotherFileOrLostAgreementsIsRefused) {
  const auto directory = folder_ / "run";
  take_up(directory);
  const auto refusal = [&] { return user_error([&] { take_up(directory); }); };
  const auto read = [&](const std::string& key) {
    return user_error([&] { read_checkpoint(chain_state_file(directory, 0), key, target_, settings_); });
  };
  EXPECT_EQ(read("key"), "");
  EXPECT_NE(read("other").find("another run"), std::string::npos);

  const std::string rows = slurp(chain_file(directory, 0));
  std::string edited = rows;
  edited[edited.rfind("\n-") + 2] ^= 1;  // the first digit of the last density
  file("run/chain-1.csv", rows.substr(0, rows.size() / 2));
  EXPECT_NE(refusal().find("shorter"), std::string::npos);
  file("run/chain-1.csv", edited);
  EXPECT_NE(refusal(), "");
  file("run/chain-1.csv", rows);
  std::filesystem::remove(warmup_state_file(directory));
  EXPECT_NE(refusal().find("warmup.state"), std::string::npos);
}

}  // namespace
}  // namespace patina
