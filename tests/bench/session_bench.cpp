// What a run costs the window, and the window a run, off screen: how soon a draw that was made is on the
// screen, how many draws a sampler loses to an open window, how long a run of a million draws takes to open
// and in how much memory: bench-session [latency|loss|opening]...
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "engine/allocator.h"
#include "engine/io/chain_csv.h"
#include "engine/io/file.h"
#include "engine/io/temporary_folder.h"
#include "engine/material/registry.h"
#include "engine/run/run_files.h"
#include "engine/sampling/rng.h"
#include "gui/app.h"
#include "gui/window/offscreen_window.h"
#include "tests/gui/fake_source.h"

namespace patina {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::filesystem::path sample() { return data_directory() / "photos" / "sample_bump.png"; }

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Of a sample's median, were it normal but for some far outliers, which a busy machine makes.
double standard_error(const std::vector<double>& values, double middle) {
  std::vector<double> distances;
  for (const double value : values) distances.push_back(std::abs(value - middle));
  return 1.2533 * 1.4826 * median(distances) / std::sqrt(static_cast<double>(values.size()));
}

/// From a draw's entry into the queue to the end of the frame that shows it, draws coming one by one.
void latency() {
  const TemporaryFolder folder;
  const auto run = std::make_shared<testing::FakeRun>();
  const ParameterTable table = material_table("bump");
  std::function<void()> wake;
  RunFactory factory;
  factory.start = [&](const RunSettings& settings, const Photo& photo, const std::filesystem::path& directory,
                      std::function<void()> wake_window) {
    wake = std::move(wake_window);
    return std::make_unique<testing::FakeSource>(run, settings, table, photo.image, directory);
  };
  const auto window = OffscreenWindow::make(1280, 800);
  App app(*window, factory, folder.path() / "runs");
  app.load(sample());
  app.session().start();
  run->status.phase = RunPhase::sampling;
  do app.frame(0.1);
  while (app.previews_waiting());  // the first render loads the engine

  constexpr std::size_t kDraws = 200;
  std::vector<Clock::time_point> made(kDraws);
  std::jthread sampler([&] {
    Rng rng(1);
    for (std::size_t i = 0; i < kDraws; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20 + rng.below(100)));
      Draw draw;
      draw.iteration = static_cast<std::int64_t>(i);
      draw.values = prior_location(table);
      made[i] = Clock::now();
      run->queue.push(draw);
      wake();
    }
  });
  std::vector<double> waits;
  while (waits.size() < kDraws) {
    app.frame();
    while (waits.size() < app.session().model().draws().size())
      waits.push_back(seconds_since(made[waits.size()]));
  }
  std::sort(waits.begin(), waits.end());
  std::printf("a draw on the screen after its making: median %.0f ms, 99th percentile %.0f ms (%zu draws)\n",
              1e3 * waits[kDraws / 2], 1e3 * waits[kDraws * 99 / 100], kDraws);
}

/// Transitions a second with frames drawn as a desktop asks for them, against none, in short turns of one run
/// after warm-up; of few pixels, so that a turn has many transitions to count.
void loss() {
  constexpr int kPairs = 60;
  constexpr double kTurn = 1.5;  // seconds
  const TemporaryFolder folder;
  const auto window = OffscreenWindow::make(1280, 800);
  App app(*window, {}, folder.path() / "runs");
  app.load(sample());
  RunChoices& choices = app.session().choices();
  RunSettings settings = choices.settings();
  settings.stop = {.minutes = 0, .ess = 0, .rhat = 0};
  settings.resolution = 64;
  settings.warmup = 150;
  settings.draws = 1'000'000;
  choices = RunChoices(settings);
  app.session().start();
  while (app.session().model().draws().sampling_count() == 0) app.frame(0.1);

  const auto steps = [&] {
    std::int64_t sum = 0;
    for (const ChainStatus& chain : app.session().run().status().chains) sum += chain.iteration;
    return static_cast<double>(sum);
  };
  const auto turn = [&](bool open) {
    app.frame(0);  // what came before is taken in by neither
    const double before = steps();
    const auto start = Clock::now();
    while (seconds_since(start) < kTurn) {
      if (open)
        app.frame(0.1);
      else
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return (steps() - before) / seconds_since(start);
  };
  std::vector<double> losses;
  for (int pair = 0; pair < kPairs; ++pair) {
    const bool open_first = pair % 2 == 0;
    const double first = turn(open_first), second = turn(!open_first);
    losses.push_back(100 * (1 - (open_first ? first / second : second / first)));
  }
  const double middle = median(losses);
  std::printf("draws lost to an open window: %.1f %% +- %.1f (median, standard error; %d pairs of %g s)\n",
              middle, standard_error(losses, middle), kPairs, kTurn);
}

/// A run directory with so many draws a chain: those of a short run, scattered.
std::filesystem::path make_run(const std::filesystem::path& folder, int draws) {
  RunSettings settings;
  settings.resolution = 64;
  settings.warmup = 50;
  settings.draws = 50;
  const auto directory = folder / "run";
  {
    const auto run = start_run(settings, load_photo(sample()), directory);
    while (run->status().phase != RunPhase::finished)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  Rng rng(1);
  for (int chain = 0; chain < settings.chains; ++chain) {
    const auto file = chain_file(directory, chain);
    ChainCsvReader reader(file);
    const auto rows = reader.read_new();
    ChainCsvHeader header = reader.header();
    header.num_samples = draws;
    std::filesystem::remove(file);
    ChainCsvWriter writer(file, header);
    for (const auto& row : rows)
      if (row.warmup) writer.append(row.row);
    writer.adaptation_terminated(0.5, std::vector<double>(header.names.size(), 1.0));
    for (int i = 0; i < draws; ++i) {
      ChainCsvRow row = rows.back().row;
      for (double& value : row.values) value *= 1 + 0.01 * rng.normal();
      writer.append(row);
    }
    writer.close();
  }
  return directory;
}

/// Kilobytes, as the kernel counts them.
double status_field(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == name) {
      double value = 0;
      status >> value;
      return value;
    }
  return 0;
}

void opening() {
  constexpr int kDraws = 250'000;  // of each of four chains
  const TemporaryFolder folder;
  const auto directory = make_run(folder.path(), kDraws);
  const auto window = OffscreenWindow::make(1280, 800);
  App app(*window, {}, folder.path() / "runs");
  app.frame(0);
  const auto start = Clock::now();
  app.open(directory);
  double longest = 0;
  while (app.session().model().draws().size() < 4 * kDraws) {
    const auto frame = Clock::now();
    app.frame(0.01);
    longest = std::max(longest, seconds_since(frame));
  }
  app.frame(0);
  std::printf("a run of 1,000,000 draws opened in %.2f s, longest frame %.2f s, memory %.2f GB\n",
              seconds_since(start), longest, status_field("VmRSS:") / (1 << 20));
}

}  // namespace
}  // namespace patina

int main(int argc, char** argv) {
  const std::vector<std::string> asked(argv + 1, argv + argc);
  const auto wanted = [&](const char* name) { return asked.empty() || std::ranges::count(asked, name) > 0; };
  if (wanted("latency")) patina::latency();
  if (wanted("loss")) patina::loss();
  if (wanted("opening")) patina::opening();
}
