#include <cmath>
#include <functional>

#include "engine/material/registry.h"
#include "engine/summary/device.h"
#include "engine/summary/precision.h"
#include "tests/run/run_fixture.h"

namespace patina {
namespace {

class StartRunRefuses : public RunTest {
 protected:
  /// The sentence with which start_run() refuses changed settings; nothing may be left on disk.
  std::string refusal(const std::function<void(RunSettings&)>& change) const {
    RunSettings changed = settings();
    change(changed);
    const std::string sentence = user_error([&] { start(changed); });
    EXPECT_FALSE(std::filesystem::exists(directory())) << sentence;
    return sentence;
  }
};

TEST_F(StartRunRefuses, UnknownNames) {
  EXPECT_NE(refusal([](auto& s) { s.material = "nosuch"; }).find("nosuch"), std::string::npos);
  EXPECT_NE(refusal([](auto& s) { s.summary = "nosuch"; }).find("nosuch"), std::string::npos);
  EXPECT_NE(refusal([](auto& s) { s.kernel = "nosuch"; }).find("nosuch"), std::string::npos);
  EXPECT_NE(refusal([](auto& s) { s.metric = "nosuch"; }).find("nosuch"), std::string::npos);
  EXPECT_NE(refusal([](auto& s) { s.discrete = "nosuch"; }).find("nosuch"), std::string::npos);
  EXPECT_NE(refusal([](auto& s) { s.device = "nosuch"; }).find("cpu, cuda"), std::string::npos);
  EXPECT_NE(refusal([](auto& s) { s.precision = "nosuch"; }).find("float32, bfloat16"), std::string::npos);
  EXPECT_NE(refusal([](auto& s) { s.fixed["nosuch"] = 1; }).find("nosuch"), std::string::npos);
  EXPECT_NE(refusal([](auto& s) { s.priors["nosuch"] = {}; }).find("nosuch"), std::string::npos);
}

TEST_F(StartRunRefuses, ImpossibleNumbers) {
  EXPECT_NE(refusal([](auto& s) { s.chains = 0; }).find("chains"), std::string::npos);
  EXPECT_NE(refusal([](auto& s) { s.chains = 100000; }).find("chains"), std::string::npos);
  EXPECT_NE(refusal([](auto& s) { s.warmup = -1; }).find("warm-up"), std::string::npos);
  EXPECT_NE(refusal([](auto& s) { s.draws = 0; }).find("draws"), std::string::npos);
  EXPECT_NE(refusal([](auto& s) { s.resolution = 8; }).find("resolution"), std::string::npos);
  EXPECT_NE(refusal([](auto& s) { s.alpha = 0; }).find("alpha"), std::string::npos);
  for (const int temper : {-3, 1, 65})
    EXPECT_NE(refusal([&](auto& s) { s.temper = temper; }).find(std::to_string(temper) + ": choose from 2"),
              std::string::npos);
  EXPECT_NE(refusal([](auto& s) { s.capture.size_cm = 0; }).find("size"), std::string::npos);
  EXPECT_NE(refusal([](auto& s) { s.capture.camera_cm = NAN; }).find("camera"), std::string::npos);
  EXPECT_NE(refusal([](auto& s) { s.fixed["rough"] = 7; }).find("rough"), std::string::npos);
  EXPECT_NE(refusal([](auto& s) {
              s.priors["rough"] = {0.4, 0.1, 0.6, 0.2};
            }).find("low"),
            std::string::npos);
}

TEST_F(StartRunRefuses, EmulatedProposalsWhereThereAreNone) {
  const auto sentence = [&](const std::function<void(RunSettings&)>& change) {
    return refusal([&](auto& s) {
      s.kernel = "emulated";
      change(s);
    });
  };
  const auto only_places = [](auto& s) {
    s.material = "leather";
    const ParameterTable table = material_table("leather");
    for (const Parameter& parameter : table.continuous)
      if (!parameter.place) s.fixed[parameter.name] = parameter.prior.mean;
  };
  EXPECT_NE(sentence(only_places).find("places of a texture"), std::string::npos);
  EXPECT_NE(sentence([](auto& s) { s.errors = "calibrated"; }).find("calibrated errors"), std::string::npos);
  EXPECT_NE(sentence([](auto& s) { s.temper = 4; }).find("ladder"), std::string::npos);
  EXPECT_NE(sentence([](auto& s) { s.start = "prior"; }).find("best match"), std::string::npos);
}

TEST_F(StartRunRefuses, APrecisionThatThisProcessorGainsNothingFrom) {
  if (bfloat16_pays()) GTEST_SKIP() << "this one gains";
  EXPECT_NE(refusal([](auto& s) { s.precision = "bfloat16"; }).find("leave it at float32"),
            std::string::npos);
}

TEST_F(StartRunRefuses, ADeviceThatIsNotAtHand) {
  if (is_at_hand(Device::cuda)) GTEST_SKIP() << "this machine has it";
  EXPECT_NE(refusal([](auto& s) { s.device = "cuda"; }).find("leave the device at cpu"), std::string::npos);
}

TEST_F(StartRunRefuses, ANetworkThatIsNone) {
  const auto jpeg = file("network.safetensors", "\xFF\xD8\xFF not a network");
  EXPECT_NE(refusal([&](auto& s) { s.summary = "gram", s.network = jpeg; }), "");
}

TEST_F(StartRunRefuses, ToInferNothing) {
  const Renderer renderer("bump", 1, Capture{});
  EXPECT_NE(refusal([&](auto& s) {
              for (const Parameter& parameter : renderer.table().continuous)
                s.fixed[parameter.name] = parameter.prior.mean;
            }).find("fixed"),
            std::string::npos);
}

TEST_F(StartRunRefuses, ADirectoryThatHoldsARun) {
  draws_to_the_end(*start(settings()));
  const std::string before = slurp(directory() / "chain-1.csv");
  EXPECT_NE(user_error([&] { start(settings()); }).find("holds a run already"), std::string::npos);
  EXPECT_EQ(slurp(directory() / "chain-1.csv"), before);
}

TEST_F(StartRunRefuses, ADirectoryThatCannotBeMade) {
  file("run", "a file is in the way");
  EXPECT_NE(user_error([&] { start(settings()); }).find("folder"), std::string::npos);
  EXPECT_NE(user_error([&] { start_run(settings(), photo(), "/proc/nosuch/run"); }), "");
}

TEST_F(StartRunRefuses, NothingAboutAnEmptyDirectory) {
  std::filesystem::create_directories(directory());
  EXPECT_EQ(user_error([&] { start(settings()); }), "");
}

}  // namespace
}  // namespace patina
