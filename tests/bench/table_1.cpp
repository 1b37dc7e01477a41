// The paper's Table 1, made anew: seconds of 1000 MALA iterations, warm-up included, on renders of 512 pixels
// compared by VGG-19's Gram matrices (random weights), of one chain that begins at the priors' means. The
// photo is a render of a draw from the prior under other irregularities. Beside the seconds the parts of an
// evaluation: of a median one, what its render alone takes there and back, the rest being the network.
//   table-1 [--device cpu|cuda] [--precision float32|bfloat16] [--iterations N] [--resolution N]
//   [MATERIAL]...
#include <ATen/TensorOperators.h>
#include <ATen/ops/ones_like.h>
#include <ATen/ops/scalar_tensor.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/allocator.h"
#include "engine/io/temporary_folder.h"
#include "engine/material/material.h"
#include "engine/material/photograph.h"
#include "engine/material/registry.h"
#include "engine/material/renderer.h"
#include "engine/posterior/posterior.h"
#include "engine/run/threads.h"
#include "engine/sampling/kernels.h"
#include "engine/sampling/prior_draw.h"
#include "engine/sampling/rng.h"
#include "engine/sampling/sample.h"
#include "engine/summary/device.h"
#include "engine/summary/precision.h"
#include "tests/bench/random_vgg19.h"
#include "tests/bench/timing.h"

namespace patina {
namespace {

constexpr std::uint64_t kPhotoSeed = 2;

/// Of the paper, seconds on a six-core i7-6800K with a GTX 1080.
const std::map<std::string, int> kPaper{{"bump", 180},  {"leather", 194}, {"plaster", 190},
                                        {"flake", 187}, {"metal", 182},   {"wood", 290}};

struct Asked {
  std::string device = "cpu", precision = "float32";
  int iterations = 1000, resolution = 512;
  std::vector<std::string> materials;
};

Posterior target_of(const std::string& material, const Asked& asked, const std::filesystem::path& network) {
  PosteriorSettings settings;
  settings.material = material;
  settings.resolution = asked.resolution;
  settings.network = network;
  settings.precision = asked.precision;
  settings.device = asked.device;
  const Renderer renderer(material, kPhotoSeed, settings.capture);
  const ParameterValues middle = prior_location(renderer.table());
  const Posterior by_middle(settings, renderer.render(middle, asked.resolution));
  Rng rng(kPhotoSeed);
  return Posterior(settings, renderer.render(by_middle.values(prior_draw(by_middle, rng)), asked.resolution));
}

/// Of a render and its gradient, as an evaluation has them.
double render_milliseconds(const std::string& name, const Asked& asked, int repeats) {
  const auto material = make_material(name);
  const Irregularities z(1);
  const Capture capture;
  const ParameterValues values = prior_location(material->table());
  const int side = material->oversampling() * asked.resolution;
  std::vector<double> times;
  for (int i = -1; i < repeats; ++i) {  // the first to warm up
    const double time = milliseconds([&] {
      std::vector<at::Tensor> leaves;
      for (const double value : values.continuous)
        leaves.push_back(at::scalar_tensor(value, at::kFloat).set_requires_grad(true));
      const at::Tensor image = photograph(
          material->surface(ParameterTensors(std::move(leaves)), values.discrete, z, capture, side), capture,
          side, DisplayCurve::srgb);
      image.backward(at::ones_like(image));
    });
    if (i >= 0) times.push_back(time);
  }
  return median(times);
}

/// Algorithm 1. Coordinates that no gradient moves walk at random.
std::unique_ptr<Kernel> paper_kernel(const Posterior& target) {
  constexpr double kContinuous = 0.8;
  if (target.discrete_levels().empty()) return make_mala();
  return make_mixture(make_mala(), make_discrete_move(), kContinuous);
}

void report(const std::string& material, const Asked& asked, const std::filesystem::path& network) {
  constexpr int kRepeats = 11;
  const Posterior target = target_of(material, asked, network);
  const Position start = target.position(prior_location(target.table()));
  std::vector<double> evaluations;
  for (int i = -2; i < kRepeats; ++i) {  // two to warm up
    const double time = milliseconds([&] { target.evaluate(start); });
    if (i >= 0) evaluations.push_back(time);
  }
  const std::unique_ptr<Kernel> kernel = paper_kernel(target);
  SampleSettings settings{.chains = 1, .warmup = asked.iterations / 2};
  settings.draws = asked.iterations - settings.warmup;
  settings.noise_repeats = 0;
  settings.enter_thread = [] { use_tensor_threads(hardware_threads()); };
  Sample drawn;
  const double seconds =
      1e-3 * milliseconds([&] {
        drawn = sample(
            target, *kernel, settings, [&](Rng&) { return start; }, Metric::identity(target.dimension()));
      });
  const auto found = kPaper.find(material);
  std::printf("| %s | %d | %.1f | %s | %.0f | %.0f | %.2f |\n", material.c_str(),
              static_cast<int>(target.dimension() + std::ssize(target.discrete_levels())), seconds,
              found == kPaper.end() ? "" : std::to_string(found->second).c_str(), median(evaluations),
              render_milliseconds(material, asked, kRepeats), drawn.acceptance.front());
  std::fflush(stdout);
}

}  // namespace
}  // namespace patina

int main(int argc, char** argv) {
  patina::Asked asked{.materials = patina::material_names()};
  CLI::App app("The paper's Table 1, made anew");
  app.add_option("MATERIAL", asked.materials)->check(CLI::IsMember(patina::material_names()));
  app.add_option("--device", asked.device)->check(CLI::IsMember(patina::device_names()));
  app.add_option("--precision", asked.precision)->check(CLI::IsMember(patina::precision_names()));
  app.add_option("--iterations", asked.iterations)->check(CLI::Range(2, 100'000));
  app.add_option("--resolution", asked.resolution)->check(CLI::Range(64, 1024));
  CLI11_PARSE(app, argc, argv);
  patina::use_tensor_threads(patina::hardware_threads());
  const patina::TemporaryFolder folder;
  const auto network = folder.path() / "vgg19.safetensors";
  patina::write_random_vgg19(network);
  std::printf("%d MALA iterations at %d pixels, VGG-19 in %s on %s, %d threads\n\n", asked.iterations,
              asked.resolution, asked.precision.c_str(), asked.device.c_str(), patina::hardware_threads());
  std::puts("| | parameters | seconds | the paper's | an evaluation, ms | of it the render | acceptance |");
  std::puts("|---|---|---|---|---|---|---|");
  for (const std::string& material : asked.materials) patina::report(material, asked, network);
}
