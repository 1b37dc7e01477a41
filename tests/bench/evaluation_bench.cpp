// What one step of a sampler costs: log density and gradient, one thread, by material and resolution.
#include <ATen/Parallel.h>
#include <benchmark/benchmark.h>

#include "engine/allocator.h"
#include "engine/material/registry.h"
#include "engine/material/renderer.h"
#include "engine/posterior/posterior.h"
#include "engine/sampling/rng.h"

namespace patina {
namespace {

void log_density_and_gradient(benchmark::State& state, const std::string& material) {
  at::set_num_threads(1);
  const Renderer renderer(material, 2, Capture{});
  const Image photo = renderer.render(prior_location(renderer.table()), 512);
  PosteriorSettings settings;
  settings.material = material;
  settings.resolution = static_cast<int>(state.range(0));
  const Posterior posterior(settings, photo);

  Rng rng(1);
  Position position = posterior.position(prior_location(posterior.table()));
  const Eigen::VectorXd centre = position.continuous;
  for (auto _ : state) {
    position.continuous = centre + 0.2 * rng.normals(centre.size());
    benchmark::DoNotOptimize(posterior.evaluate(position).log_density);
  }
}

}  // namespace
}  // namespace patina

int main(int argc, char** argv) {
  for (const std::string& material : patina::material_names())
    benchmark::RegisterBenchmark(("log_density_and_gradient/" + material).c_str(),
                                 patina::log_density_and_gradient, material)
        ->Arg(128)
        ->Arg(256)
        ->Arg(512)
        ->Unit(benchmark::kMillisecond)
        ->MinTime(2.0);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
