#include "engine/run/export_draw.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "engine/io/file.h"
#include "engine/io/image_file.h"
#include "engine/io/params_json.h"
#include "engine/material/renderer.h"
#include "engine/run/run_checks.h"
#include "engine/run/version.h"

namespace patina {
namespace {

float encode_srgb(float linear) {
  const float x = std::clamp(linear, 0.0f, 1.0f);
  return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
}

template <typename Function>
Image transformed(Image image, Function function) {
  std::ranges::transform(image.pixels, image.pixels.begin(), function);
  return image;
}

/// One number a pixel out of x and y; their mean where the lobe is anisotropic.
Image roughness_image(const LobeMaps& lobe) {
  Image image(lobe.roughness.width, lobe.roughness.height, 1);
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column)
      image.at(row, column, 0) =
          0.5f * (lobe.roughness.at(row, column, 0) + lobe.roughness.at(row, column, 1));
  return image;
}

struct Heights {
  float low = 0, high = 0;  ///< cm
};

Heights range_of(const Image& height) {
  const auto [low, high] = std::ranges::minmax(height.pixels);
  return {low, high};
}

void write_images(const MaterialMaps& maps, const Heights& heights, const std::filesystem::path& folder) {
  write_image(folder / "base_color.png", transformed(maps.base_color, encode_srgb), PixelDepth::u16);
  write_image(folder / "normal_gl.png", transformed(maps.normal, [](float n) { return 0.5f * (n + 1); }),
              PixelDepth::u16);
  if (!maps.lobes.empty())
    write_image(folder / "roughness.png", roughness_image(maps.lobes.front()), PixelDepth::u16);
  const float range = heights.high > heights.low ? heights.high - heights.low : 1;
  write_image(folder / "height.png",
              transformed(maps.height, [&](float h) { return (h - heights.low) / range; }), PixelDepth::u16);
}

std::string sidecar(const ExportRequest& request, const Capture& shown, const Heights& heights) {
  const nlohmann::ordered_json json = {
      {"program", program_version()},
      {"material", request.material},
      {"z_seed", request.z_seed},
      {"resolution", request.resolution},
      {"size_cm", shown.size_cm},
      {"tile", request.tile},
      {"sample_size_cm", request.capture.size_cm},
      {"camera_cm", request.capture.camera_cm},
      {"height_cm", {{"black", heights.low}, {"white", heights.high}}},
      {"normal", "OpenGL: red to the right, green up, blue out of the surface"},
      {"color_space",
       {{"render.png", "sRGB"},
        {"base_color.png", "sRGB"},
        {"normal_gl.png", "raw"},
        {"roughness.png", "raw"},
        {"height.png", "raw"}}}};
  return json.dump(2) + "\n";
}

}  // namespace

void export_draw(const ExportRequest& request, const std::filesystem::path& folder) {
  check_resolution(request.resolution);
  const Renderer renderer(request.material, request.z_seed, request.capture);
  const MaterialMaps maps = request.tile ? renderer.tile(request.values, request.resolution)
                                         : renderer.maps(request.values, request.resolution);
  make_folder(folder);
  const Heights heights = range_of(maps.height);
  write_images(maps, heights, folder);
  write_image(folder / "render.png", renderer.render(request.values, request.resolution));
  write_file_atomically(folder / "params.json", params_to_json(renderer.table(), request.values));
  write_file_atomically(folder / "maps.json", sidecar(request, maps.capture, heights));
}

}  // namespace patina
