#include "engine/material/renderer.h"

#include <ATen/core/Tensor.h>
#include <ATen/core/grad_mode.h>
#include <ATen/ops/stack.h>
#include <ATen/ops/tensor.h>

#include <cassert>
#include <cstring>

#include "engine/error.h"
#include "engine/material/capture_priors.h"
#include "engine/material/material.h"
#include "engine/material/photograph.h"
#include "engine/material/registry.h"

namespace patina {
namespace {

/// An interleaved image of [c, h, w], repeated to n x n where a side is 1.
Image to_image(const at::Tensor& planes, int n) {
  const std::int64_t channels = planes.size(0);
  const at::Tensor pixels = planes.expand({channels, n, n}).permute({1, 2, 0}).to(at::kFloat).contiguous();
  Image image(n, n, static_cast<int>(channels));
  std::memcpy(image.pixels.data(), pixels.data_ptr<float>(), image.pixels.size() * sizeof(float));
  return image;
}

at::Tensor as_plane(const at::Tensor& scalar_or_plane, int n) { return scalar_or_plane.expand({n, n}); }

LobeMaps to_maps(const Lobe& lobe, int n) {
  // A uniform F0 is all that the models have; the maps carry it as three numbers.
  const at::Tensor f0 =
      lobe.f0.view({lobe.f0.size(0), -1}).select(1, 0).expand({3}).to(at::kFloat).contiguous();
  LobeMaps maps;
  maps.normal = to_image(lobe.normal, n);
  maps.roughness = to_image(at::stack({as_plane(lobe.roughness_x, n), as_plane(lobe.roughness_y, n)}), n);
  std::memcpy(maps.f0.data(), f0.data_ptr<float>(), sizeof maps.f0);
  return maps;
}

}  // namespace

struct Renderer::Parts {
  std::string name;
  std::shared_ptr<const Material> material;
  Irregularities z;
  Capture capture;
  ParameterTable table = table_under(material->table(), capture);

  Surface surface(const ParameterValues& values, const Capture& seen, int resolution) const {
    if (resolution < 16 || resolution > 4096)
      throw UserError("Cannot render " + std::to_string(resolution) +
                      " pixels a side: choose a resolution from 16 to 4096.");
    assert(values.continuous.size() == table.continuous.size());
    assert(values.discrete.size() == table.discrete.size());
    return material->surface(at::tensor(values.continuous, at::kFloat), values.discrete, z, seen, resolution);
  }

  MaterialMaps maps(const ParameterValues& values, const Capture& seen, int resolution) const {
    const at::NoGradGuard no_grad;
    const Surface surface = this->surface(values, seen, resolution);
    MaterialMaps maps;
    maps.base_color = to_image(surface.base_color, resolution);
    maps.height = to_image(surface.height.unsqueeze(0), resolution);
    maps.normal = to_image(surface.normal, resolution);
    for (const Lobe& lobe : surface.lobes) maps.lobes.push_back(to_maps(lobe, resolution));
    maps.light = surface.light.item<float>();
    maps.vignette_sigma = surface.vignette_sigma.item<float>();
    maps.capture = seen;
    return maps;
  }
};

Renderer::Renderer(const std::string& material, std::uint64_t z_seed, Capture capture)
    : parts_(new Parts{material, make_material(material), Irregularities(z_seed), capture}) {}

Renderer::~Renderer() = default;

const ParameterTable& Renderer::table() const { return parts_->table; }

MaterialMaps Renderer::maps(const ParameterValues& values, int resolution) const {
  return parts_->maps(values, parts_->capture, resolution);
}

bool Renderer::has_tile() const { return parts_->material->tiling() != Tiling::none; }

MaterialMaps Renderer::tile(const ParameterValues& values, int resolution) const {
  switch (parts_->material->tiling()) {
    case Tiling::sample:
      return maps(values, resolution);
    case Tiling::map: {
      const WholePeriod period = whole_period(table(), values, parts_->capture);
      return parts_->maps(period.values, period.capture, resolution);
    }
    case Tiling::book_matched:
      if (resolution % 2 != 0 || resolution < 32 || resolution > 4096)
        throw UserError("A tile of " + parts_->name +
                        " is made of mirror images: choose an even resolution from 32 to 4096.");
      return book_matched(maps(values, resolution / 2));
    case Tiling::none:
      break;
  }
  throw UserError("There is no tile of " + parts_->name +
                  ", which glows around one point of light: export it without tiling.");
}

Image Renderer::render(const ParameterValues& values, int resolution, DisplayCurve curve) const {
  const at::NoGradGuard no_grad;
  const Surface surface = parts_->surface(values, parts_->capture, resolution);
  return to_image(photograph(surface, parts_->capture, resolution, curve), resolution);
}

}  // namespace patina
