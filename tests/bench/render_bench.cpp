// What a render and its gradient cost beside the network's Gram matrices and theirs, and the shading in one
// pass over pixels beside the same as tensor operations; one thread, medians of interleaved repeats.
//   bench-render [--repeats 9] [--resolution 512] [MATERIAL]...
#include <ATen/Parallel.h>
#include <ATen/TensorOperators.h>
#include <ATen/ops/rand.h>
#include <ATen/ops/rand_like.h>
#include <ATen/ops/scalar_tensor.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/allocator.h"
#include "engine/material/material.h"
#include "engine/material/photograph.h"
#include "engine/material/registry.h"
#include "engine/material/shading.h"
#include "engine/summary/summary.h"
#include "tests/bench/timing.h"

namespace patina {
namespace {

/// Medians of each of several works, which take turns; one more turn comes first, to warm up.
std::vector<double> medians(const std::vector<std::function<void()>>& works, int repeats) {
  std::vector<std::vector<double>> times(works.size());
  for (int i = -1; i < repeats; ++i)
    for (std::size_t w = 0; w < works.size(); ++w) {
      const double time = milliseconds(works[w]);
      if (i >= 0) times[w].push_back(time);
    }
  std::vector<double> result;
  for (const std::vector<double>& of_one : times) result.push_back(median(of_one));
  return result;
}

/// The tensors of a surface as leaves that ask for a gradient if those do; what lobes share stays shared.
Surface as_leaves(Surface surface) {
  const auto leaf = [](const at::Tensor& tensor) {
    return tensor.requires_grad() ? tensor.detach().clone().set_requires_grad(true) : tensor;
  };
  const at::Tensor normal = leaf(surface.normal);
  for (Lobe& lobe : surface.lobes) {
    lobe.normal = lobe.normal.is_same(surface.normal) ? normal : leaf(lobe.normal);
    const bool isotropic = lobe.roughness_x.is_same(lobe.roughness_y);
    lobe.f0 = lobe.f0.detach();
    lobe.roughness_x = leaf(lobe.roughness_x);
    lobe.roughness_y = isotropic ? lobe.roughness_x : leaf(lobe.roughness_y);
  }
  surface.normal = normal;
  surface.base_color = leaf(surface.base_color);
  surface.light = leaf(surface.light);
  surface.vignette_sigma = leaf(surface.vignette_sigma);
  return surface;
}

/// What a backward pass has left, so that the next one need not add to it.
void forget_gradients(const Surface& surface) {
  std::vector<at::Tensor> leaves{surface.normal, surface.base_color, surface.light, surface.vignette_sigma};
  for (const Lobe& lobe : surface.lobes)
    leaves.insert(leaves.end(), {lobe.normal, lobe.roughness_x, lobe.roughness_y});
  for (at::Tensor& leaf : leaves) leaf.mutable_grad().reset();
}

void report(const std::string& name, int repeats, int resolution) {
  const auto material = make_material(name);
  const Irregularities z(2);
  const Capture capture;
  const ParameterValues values = prior_location(material->table());
  const auto parameters = [&] {
    std::vector<at::Tensor> leaves;
    for (const double value : values.continuous)
      leaves.push_back(at::scalar_tensor(value, at::kFloat).set_requires_grad(true));
    return ParameterTensors(std::move(leaves));
  };
  const auto surface = [&] {
    return material->surface(parameters(), values.discrete, z, capture, resolution);
  };
  const auto summary = make_summary("gram", {});
  const at::Tensor image = at::rand({3, resolution, resolution}), by_image = at::rand_like(image);
  const Surface shown = as_leaves(surface());

  const std::vector<double> times =
      medians({[&] {
                 const at::Tensor leaf = image.detach().set_requires_grad(true);
                 (*summary)(leaf).square().sum().backward();
               },
               [&] { photograph(surface(), capture, resolution, DisplayCurve::srgb).backward(by_image); },
               [&] {
                 photograph(shown, capture, resolution, DisplayCurve::srgb).backward(by_image);
                 forget_gradients(shown);
               },
               [&] {
                 display(shade(shown, capture, resolution), DisplayCurve::srgb).backward(by_image);
                 forget_gradients(shown);
               }},
              repeats);
  std::printf("| %s | %.0f | %.1f | %.0f %% | %.1f | %.1f | %.1f |\n", name.c_str(), times[0], times[1],
              100 * times[1] / times[0], times[2], times[3], times[3] / times[2]);
}

}  // namespace
}  // namespace patina

int main(int argc, char** argv) {
  int repeats = 9, resolution = 512;
  std::vector<std::string> materials = patina::material_names();
  CLI::App app("What a render costs beside the network");
  app.add_option("--repeats", repeats)->check(CLI::Range(1, 10'000));
  app.add_option("--resolution", resolution)->check(CLI::Range(64, 1024));
  app.add_option("MATERIAL", materials)->check(CLI::IsMember(patina::material_names()));
  CLI11_PARSE(app, argc, argv);
  at::set_num_threads(1);
  std::puts("| | network, ms | render, ms | share | shading in one pass, ms | by tensors, ms | times |");
  std::puts("|---|---|---|---|---|---|---|");
  for (const std::string& name : materials) patina::report(name, repeats, resolution);
}
