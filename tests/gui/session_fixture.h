#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "engine/error.h"
#include "engine/io/image_file.h"
#include "engine/io/temporary_folder.h"
#include "gui/session.h"
#include "tests/gui/fake_source.h"

namespace patina::testing {

/// A session whose runs are fakes, and a small photo to open.
class SessionTest : public ::testing::Test {
 protected:
  SessionTest() {
    Image image(40, 40, 3);
    std::fill(image.pixels.begin(), image.pixels.end(), 0.5f);
    write_image(photo_, image);
  }

  RunFactory factory() {
    RunFactory factory;
    factory.start = [this](const RunSettings& settings, const Photo& photo,
                           const std::filesystem::path& directory, auto) {
      if (refuse_) throw UserError("Refused for the test.");
      started_ = settings;
      if (factory_makes_directories_) std::filesystem::create_directories(directory);
      return std::make_unique<FakeSource>(run_, settings, testing::small_table(), photo.image, directory);
    };
    factory.resume = [this](const RunSettings& settings, const std::filesystem::path& directory, auto) {
      resumed_ = settings;
      return std::make_unique<FakeSource>(run_, settings, testing::small_table(), Image(40, 40, 3),
                                          directory);
    };
    factory.open = [this](const std::filesystem::path& directory, auto) -> std::unique_ptr<DrawSource> {
      if (!std::filesystem::exists(directory / "run.json"))
        throw UserError("There is no run in " + directory.string() + ".");
      return std::make_unique<FakeSource>(run_, RunSettings(), testing::small_table(), Image(40, 40, 3),
                                          directory);
    };
    return factory;
  }

  TemporaryFolder folder_;
  std::filesystem::path photo_ = folder_.path() / "oak door.png";
  std::shared_ptr<FakeRun> run_ = std::make_shared<FakeRun>();
  RunSettings started_;
  std::optional<RunSettings> resumed_;
  bool refuse_ = false, factory_makes_directories_ = false;
  Session session_{factory(), folder_.path() / "runs", {}};
};

}  // namespace patina::testing
