#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "engine/io/photo.h"
#include "engine/material/renderer.h"
#include "engine/run/run.h"
#include "tests/cli/subprocess.h"

namespace patina {

inline bool has_ended(const DrawSource& run) {
  const RunPhase phase = run.status().phase;
  return phase == RunPhase::finished || phase == RunPhase::stopped || phase == RunPhase::failed;
}

/// Waits for the run's end; all draws that arrived since the last take.
inline std::vector<Draw> draws_to_the_end(DrawSource& run) {
  EXPECT_TRUE(comes_true([&] { return has_ended(run); })) << run.status().message;
  return run.take_draws();
}

inline Photo photo_of(Image image) {
  Photo photo;
  photo.image = std::move(image);
  photo.original_width = photo.image.width;
  photo.original_height = photo.image.height;
  photo.sha256 = "0123456789abcdef";
  return photo;
}

/// Runs on a photo of the material bump that is small enough to take milliseconds a draw.
class RunTest : public FolderTest {
 protected:
  static Photo photo() {
    static const Image image = [] {
      const Renderer renderer("bump", 2, Capture{});
      return renderer.render(prior_location(renderer.table()), 48);
    }();
    return photo_of(image);
  }

  static RunSettings settings() {
    RunSettings settings;
    settings.material = "bump";
    settings.summary = "means";
    settings.resolution = 32;
    settings.chains = 2;
    settings.warmup = 40;
    settings.draws = 30;
    settings.seed = 11;
    settings.stop = {};  // all draws, however good they are
    return settings;
  }

  /// With other errors than those that are set by hand, which take more of a run.
  static RunSettings with_errors(const std::string& errors) {
    RunSettings measured = settings();
    measured.errors = errors;
    measured.resolution = 16;
    return measured;
  }

  /// More draws than any test waits for.
  static RunSettings endless() {
    RunSettings long_settings = settings();
    long_settings.draws = 1'000'000;
    return long_settings;
  }

  std::filesystem::path directory() const { return folder_ / "run"; }

  std::unique_ptr<DrawSource> start(const RunSettings& settings) const {
    return start_run(settings, photo(), directory());
  }
};

inline std::int64_t transitions(const RunStatus& status) {
  std::int64_t made = 0;
  for (const ChainStatus& chain : status.chains) made += chain.iteration;
  return made;
}

/// The lines of a chain file that hold draws.
inline std::vector<std::string> rows_of(const std::filesystem::path& chain_file) {
  std::ifstream stream(chain_file);
  std::vector<std::string> rows;
  for (std::string line; std::getline(stream, line);)
    if (!line.empty() && line[0] != '#' && line[0] != 'l') rows.push_back(line);
  return rows;
}

}  // namespace patina
