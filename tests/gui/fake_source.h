#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/run/draw_queue.h"
#include "engine/run/draw_source.h"
#include "engine/sampling/kernels.h"
#include "gui/plot/plot_axis.h"
#include "gui/run_factory.h"

namespace patina::testing {

/// What a test and its source share: the test feeds draws and reads which buttons were pressed.
struct FakeRun {
  void feed(const std::vector<Draw>& draws) {
    for (const Draw& draw : draws) queue.push(draw);
  }

  DrawQueue queue;
  RunStatus status;
  int pauses = 0, resumes = 0, stops = 0;
};

/// A run of known draws.
class FakeSource final : public DrawSource {
 public:
  FakeSource(std::shared_ptr<FakeRun> run, RunSettings settings, ParameterTable table, Image photo,
             std::filesystem::path directory)
      : run_(std::move(run)),
        settings_(std::move(settings)),
        table_(std::move(table)),
        photo_(std::move(photo)),
        directory_(std::move(directory)) {
    if (!settings_.warmup) settings_.warmup = usual_warmup(false);  // as a run does
  }

  const std::filesystem::path& directory() const override { return directory_; }
  const RunSettings& settings() const override { return settings_; }
  const ParameterTable& table() const override { return table_; }
  const Image& photo() const override { return photo_; }
  std::vector<Draw> take_draws() override { return run_->queue.take_all(); }
  RunStatus status() const override { return run_->status; }
  bool can_control() const override { return true; }
  void pause() override { ++run_->pauses, run_->status.phase = RunPhase::paused; }
  void resume() override { ++run_->resumes, run_->status.phase = RunPhase::sampling; }
  void stop() override { ++run_->stops, run_->status.phase = RunPhase::stopped; }

 private:
  std::shared_ptr<FakeRun> run_;
  RunSettings settings_;
  ParameterTable table_;
  Image photo_;
  std::filesystem::path directory_;
};

/// Two continuous parameters in [0, 1] and one discrete of two levels.
inline ParameterTable small_table() {
  ParameterTable table;
  table.material = "bump";
  table.continuous = {{"rough", "", "", {0.5, 0.2, 0, 1}}, {"fsigma", "cycles/cm", "", {0.5, 0.2, 0, 1}}};
  table.discrete = {{"cells", "", {"fine", "coarse"}}};
  return table;
}

inline constexpr PlotAxis kX{PlotAxis::Kind::continuous, 0}, kY{PlotAxis::Kind::continuous, 1},
    kCells{PlotAxis::Kind::discrete, 0};

inline Draw draw_at(double x, double y, double lp, bool warmup = false, int chain = 0, int level = 0) {
  Draw draw;
  draw.chain = chain;
  draw.warmup = warmup;
  draw.lp = lp;
  draw.values = {{x, y}, {level}};
  return draw;
}

}  // namespace patina::testing
