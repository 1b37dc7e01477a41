// The paper's Figure 11: how much of burn-in a neural prediction spares. Photos of prior draws are fitted
// twice, chains beginning at draws from the prior and at the predictor's guesses; how far below the typical
// log density each chain is at every iteration is drawn, and the iterations until it is there are counted.
//   figure-11 OUT_FOLDER [MATERIAL=bump] [PHOTOS=4]
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "engine/chart/panel.h"
#include "engine/chart/photo_problem.h"
#include "engine/error.h"
#include "engine/io/temporary_folder.h"
#include "engine/material/registry.h"
#include "engine/run/manifest_phase.h"
#include "engine/run/run.h"
#include "engine/run/run_checks.h"

namespace patina {
namespace {

constexpr int kWarmup = 250, kDraws = 50, kChains = 4;
constexpr std::array<const char*, 2> kStarts{"prior", "predict"};

using Trace = std::vector<double>;  // lp, warm-up included

struct Photographed {
  std::array<std::vector<Trace>, 2> chains;  ///< of each of kStarts
  int free = 0;                              ///< parameters
};

std::vector<Trace> fit(RunSettings settings, const Image& image) {
  Photo photo;
  photo.image = image;
  photo.original_width = photo.original_height = image.width;
  const TemporaryFolder folder;
  const auto run = start_run(settings, photo, folder.path() / "run");
  while (!has_ended(run->status().phase)) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  if (run->status().phase == RunPhase::failed) throw UserError(run->status().message);
  std::vector<Trace> traces(kChains);
  for (const Draw& draw : run->take_draws()) traces[static_cast<std::size_t>(draw.chain)].push_back(draw.lp);
  return traces;
}

Photographed fit_both(const std::string& material, int photo) {
  RunSettings settings;
  settings.material = material;
  settings.resolution = 96;
  settings.chains = kChains;
  settings.warmup = kWarmup;
  settings.draws = kDraws;
  settings.stop = {};
  settings.seed = static_cast<std::uint64_t>(photo) + 1;
  const Image image = photo_of_prior_draw(settings, 900 + settings.seed, 700 + settings.seed);
  Photographed result;
  for (std::size_t i = 0; i < kStarts.size(); ++i) {
    settings.start = kStarts[i];
    result.chains[i] = fit(settings, image);
  }
  result.free = static_cast<int>(material_table(material).continuous.size());
  return result;
}

/// The mean log density that the best chain settles at.
double typical(const Photographed& photo) {
  double best = -1e300;
  for (const auto& chains : photo.chains)
    for (const Trace& trace : chains) {
      double mean = 0;
      for (auto lp = trace.end() - kDraws; lp != trace.end(); ++lp) mean += *lp / kDraws;
      best = std::max(best, mean);
    }
  return best;
}

/// The log density of a normal posterior of d dimensions has the sd sqrt(d / 2); below three of them it is
/// not there yet.
double reach(const Photographed& photo) { return 3 * std::sqrt(photo.free / 2.0); }

std::size_t burn_in(const Trace& trace, double level) {
  return static_cast<std::size_t>(std::ranges::find_if(trace, [&](double lp) { return lp >= level; }) -
                                  trace.begin());
}

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + std::ssize(values) / 2);
  return values[values.size() / 2];
}

void report(const std::vector<Photographed>& photos) {
  for (std::size_t start = 0; start < kStarts.size(); ++start) {
    std::vector<double> burnt;
    long never = 0;
    for (const Photographed& photo : photos)
      for (const Trace& trace : photo.chains[start]) {
        burnt.push_back(static_cast<double>(burn_in(trace, typical(photo) - reach(photo))));
        never += burnt.back() >= static_cast<double>(trace.size());
      }
    std::printf("%-8s %3.0f iterations of burn-in (median of %zu chains), %ld not there after %d\n",
                kStarts[start], median(burnt), burnt.size(), never, kWarmup + kDraws);
  }
}

void draw_start(Scene& scene, const Panel& panel, const std::vector<Photographed>& photos,
                std::size_t start) {
  Colour thin = series_colour(start);
  const Colour thick = thin;
  thin.opacity = 0.25;
  std::vector<std::vector<double>> below(kWarmup + kDraws);
  for (const Photographed& photo : photos)
    for (const Trace& trace : photo.chains[start])
      for (std::size_t i = 0; i < trace.size(); ++i) {
        below[i].push_back(std::max(typical(photo) - trace[i], 1.0));
        if (i > 0)
          scene.shapes.push_back(SceneLine{panel.at(static_cast<double>(i), *(std::prev(below[i - 1].end()))),
                                           panel.at(static_cast<double>(i + 1), below[i].back()), thin, 0.7});
      }
  for (std::size_t i = 1; i < below.size(); ++i)
    scene.shapes.push_back(SceneLine{panel.at(static_cast<double>(i), median(below[i - 1])),
                                     panel.at(static_cast<double>(i + 1), median(below[i])), thick, 3});
}

Scene draw(const std::string& material, const std::vector<Photographed>& photos) {
  Scene scene{900, 560, "Burn-in from the prior and from predictions", {}};
  add_text(scene, {24, 34}, "Burn-in of chains that begin at draws from the prior, or at predictions",
           Anchor::start, 18, kInk, true);
  add_text(scene, {24, 56},
           std::to_string(photos.size()) + " photos of " + material + ", " + std::to_string(kChains) +
               " chains each; thick: medians. Search and metric are the program's own.",
           Anchor::start, 13, kPale);
  double deepest = 10;
  for (const Photographed& photo : photos)
    for (const Trace& trace : photo.chains[0]) deepest = std::max(deepest, typical(photo) - trace.front());
  const Panel panel({70, 110, 860, 490}, LogAxis{1, kWarmup + kDraws}, LogAxis{1, 2 * deepest});
  panel.draw_frame(scene, "iteration", "nats below the typical log density (1: there)");
  for (std::size_t start = 0; start < kStarts.size(); ++start) {
    draw_start(scene, panel, photos, start);
    const double y = 130 + 22 * static_cast<double>(start);
    scene.shapes.push_back(SceneLine{{700, y - 4}, {730, y - 4}, series_colour(start), 3});
    add_text(scene, {738, y}, start == 0 ? "from the prior" : "from predictions", Anchor::start, 13, kInk);
  }
  return scene;
}

int run(const std::string& folder, const std::string& material, int count) {
  make_folder(folder);
  std::vector<Photographed> photos;
  for (int i = 0; i < count; ++i) photos.push_back(fit_both(material, i));
  report(photos);
  write_scene(folder, "figure-11", draw(material, photos));
  return 0;
}

}  // namespace
}  // namespace patina

int main(int argc, char** argv) {
  if (argc < 2 || argc > 4) {
    std::fputs("usage: figure-11 OUT_FOLDER [MATERIAL] [PHOTOS]\n", stderr);
    return 2;
  }
  try {
    const int photos = argc > 3 ? std::max(1, std::atoi(argv[3])) : 4;
    return patina::run(argv[1], argc > 2 ? argv[2] : "bump", photos);
  } catch (const patina::UserError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
