// What a user waits for, in real frames drawn off screen: a frame with 100,000 and 1,000,000 draws, in the
// plot, over all pairs and in the trace, and the render of a draw that was clicked while the sampler runs.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <vector>

#include "engine/allocator.h"
#include "engine/io/image_file.h"
#include "engine/io/temporary_folder.h"
#include "engine/material/registry.h"
#include "engine/material/renderer.h"
#include "engine/sampling/rng.h"
#include "gui/app.h"
#include "gui/window/offscreen_window.h"
#include "tests/gui/fake_source.h"

namespace patina {
namespace {

using Clock = std::chrono::steady_clock;

/// The times of one benchmark's iterations; a user feels the median and the slow ones, not the mean.
class Times {
 public:
  explicit Times(benchmark::State& state) : state_(state) {}
  ~Times() {
    if (times_.empty()) return;
    std::sort(times_.begin(), times_.end());
    state_.counters["median_ms"] = 1e3 * times_[times_.size() / 2];
    state_.counters["p99_ms"] = 1e3 * times_[times_.size() * 99 / 100];
  }
  void add(double seconds) {
    state_.SetIterationTime(seconds);
    times_.push_back(seconds);
  }

 private:
  benchmark::State& state_;
  std::vector<double> times_;
};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A photo of bump that the engine rendered, in a folder for one benchmark.
struct Scene {
  TemporaryFolder folder;
  std::filesystem::path photo = folder.path() / "photo.png";
  ParameterTable table = material_table("bump");

  Scene() { write_image(photo, Renderer("bump", 2, Capture{}).render(prior_location(table), 256)); }

  Draw random_draw(Rng& rng, int chain) const {
    Draw draw;
    draw.chain = chain;
    draw.lp = -0.5 * rng.normal() * rng.normal();
    draw.values = prior_location(table);
    for (std::size_t i = 0; i < table.continuous.size(); ++i) {
      const TruncatedNormal& prior = table.continuous[i].prior;
      draw.values.continuous[i] =
          std::clamp(prior.mean + 0.3 * prior.sd * rng.normal(), prior.low, prior.high);
    }
    return draw;
  }
};

/// One frame in which the mouse moved and ten draws arrived, beside state.range(0) that were there.
/// @param view  the key that shows what is measured
void frame_with_draws(benchmark::State& state, char view) {
  const Scene scene;
  const auto run = std::make_shared<testing::FakeRun>();
  RunFactory factory;
  factory.start = [&](const RunSettings& settings, const Photo& photo, const std::filesystem::path& directory,
                      auto) {
    return std::make_unique<testing::FakeSource>(run, settings, scene.table, photo.image, directory);
  };
  const auto window = OffscreenWindow::make(1280, 800);
  App app(*window, factory, scene.folder.path() / "runs");
  app.load(scene.photo);
  app.session().start();
  run->status.phase = RunPhase::sampling;
  Rng rng(1);
  for (int i = 0; i < state.range(0); ++i) run->queue.push(scene.random_draw(rng, i % 4));
  window->tap_key(view);
  for (int i = 0; i < 10 || app.scatter().busy(); ++i) app.frame(0);

  float x = 500;
  Times times(state);
  for (auto _ : state) {
    for (int i = 0; i < 10; ++i) run->queue.push(scene.random_draw(rng, i % 4));
    window->move_mouse(x, 400);
    x = x > 800 ? 500 : x + 3;
    const auto start = Clock::now();
    app.frame(0);
    times.add(seconds_since(start));
  }
}

bool same(const Image& a, const Image& b) { return a.pixels == b.pixels; }

/// A random draw that is not where the selected one is (a rejected proposal repeats its draw).
std::size_t another_draw(const ExplorerModel& model, Rng& rng) {
  const auto place = [&](std::size_t draw) { return model.draws().place(model.x_axis(), draw); };
  for (;;) {
    const auto draw = static_cast<std::size_t>(rng.below(static_cast<int>(model.draws().size())));
    if (!model.selected() || place(draw) != place(*model.selected())) return draw;
  }
}

/// From the end of a click on a draw, which lasts 80 ms as a hand's does, to its render at 512 pixels, four
/// chains sampling at 256 pixels all the while.
void click_to_render(benchmark::State& state) {
  const Scene scene;
  const auto window = OffscreenWindow::make(1280, 800);
  App app(*window, {}, scene.folder.path() / "runs");
  app.load(scene.photo);
  app.session().start();
  const ExplorerModel& model = app.session().model();
  while (model.draws().size() < 400) app.frame(0.02);

  Rng rng(1);
  Times times(state);
  for (auto _ : state) {
    const std::size_t draw = another_draw(model, rng);
    const PlotView& view = app.scatter().view();
    window->move_mouse(view.pixel_of_x(model.draws().place(model.x_axis(), draw)),
                       view.pixel_of_y(model.draws().place(model.y_axis(), draw)));
    window->press_mouse();
    for (const auto down = Clock::now(); seconds_since(down) < 0.08;) app.frame(0.002);
    const Image before = app.preview().render();
    const std::optional<std::size_t> selected = model.selected();
    const auto start = Clock::now();
    window->release_mouse();
    while (model.selected() == selected || app.previews_waiting()) app.frame(0.002);
    times.add(seconds_since(start));
    if (same(before, app.preview().render())) state.SkipWithError("the render is not there");
    for (int i = 0; i < 20; ++i) app.frame(0.01);
  }
}

#define FRAME_BENCHMARK(name, view)               \
  BENCHMARK_CAPTURE(frame_with_draws, name, view) \
      ->Arg(0)                                    \
      ->Arg(100'000)                              \
      ->Arg(1'000'000)                            \
      ->Iterations(300)                           \
      ->UseManualTime()                           \
      ->Unit(benchmark::kMillisecond)
FRAME_BENCHMARK(plot, 'P');
FRAME_BENCHMARK(pairs, 'A');
FRAME_BENCHMARK(trace, 'T');
BENCHMARK(click_to_render)->Iterations(60)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace patina

BENCHMARK_MAIN();
