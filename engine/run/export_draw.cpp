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

const char* extension(MapFormat format) { return format == MapFormat::exr ? ".exr" : ".png"; }

const char* normal_name(NormalConvention normals) {
  return normals == NormalConvention::opengl ? "normal_gl" : "normal_dx";
}

PixelDepth depth_of(MapFormat format) {
  switch (format) {
    case MapFormat::png8:
      return PixelDepth::u8;
    case MapFormat::png16:
      return PixelDepth::u16;
    case MapFormat::exr:
      break;
  }
  return PixelDepth::f16;
}

Image normal_image(const Image& normal, NormalConvention normals) {
  Image image = transformed(normal, [](float n) { return 0.5f * (n + 1); });
  if (normals == NormalConvention::opengl) return image;
  for (std::size_t green = 1; green < image.pixels.size(); green += 3)
    image.pixels[green] = 1 - image.pixels[green];
  return image;
}

void write_images(const ExportRequest& request, const MaterialMaps& maps, const Heights& heights,
                  const std::filesystem::path& folder, const std::function<void()>& made_one) {
  const bool exr = request.format == MapFormat::exr;
  const auto write = [&](const std::string& name, const Image& image) {
    // Heights in cm need more digits than a half has.
    const PixelDepth depth = exr && name == "height" ? PixelDepth::f32 : depth_of(request.format);
    write_image(folder / (name + extension(request.format)), image, depth);
    made_one();
  };
  write("base_color", exr ? maps.base_color : transformed(maps.base_color, encode_srgb));
  write(normal_name(request.normals), normal_image(maps.normal, request.normals));
  if (!maps.lobes.empty()) write("roughness", roughness_image(maps.lobes.front()));
  const float range = heights.high > heights.low ? heights.high - heights.low : 1;
  write("height",
        exr ? maps.height : transformed(maps.height, [&](float h) { return (h - heights.low) / range; }));
}

using Json = nlohmann::ordered_json;

Json origin_json(const DrawOrigin& origin) {
  Json json = Json::object();
  const auto add = [&](const char* key, const std::string& text) {
    if (!text.empty()) json[key] = text;
  };
  add("photo", origin.photo);
  add("photo_sha256", origin.photo_sha256);
  add("run", origin.run);
  add("draw", origin.draw);
  return json;
}

Json height_json(MapFormat format, const Heights& heights) {
  if (format == MapFormat::exr) return {{"unit", "cm"}, {"lowest", heights.low}, {"highest", heights.high}};
  return {{"black", heights.low}, {"white", heights.high}};
}

std::string sidecar(const ExportRequest& request, const MaterialMaps& maps, const Heights& heights) {
  Json spaces = Json::object();
  for (const ExportedFile& file : exported_files(request.format, request.normals)) {
    const bool written = !file.name.starts_with("roughness") || !maps.lobes.empty();
    if (written && !file.color_space.empty()) spaces[file.name] = file.color_space;
  }
  const bool up = request.normals == NormalConvention::opengl;
  const Json json = {{"program", program_version()},
                     {"material", request.material},
                     {"origin", origin_json(request.origin)},
                     {"z_seed", request.z_seed},
                     {"resolution", request.resolution},
                     {"size_cm", maps.capture.size_cm},
                     {"tile", request.tile},
                     {"sample_size_cm", request.capture.size_cm},
                     {"camera_cm", request.capture.camera_cm},
                     {"height_cm", height_json(request.format, heights)},
                     {"normal", up ? "OpenGL: red to the right, green up, blue out of the surface"
                                   : "DirectX: red to the right, green down, blue out of the surface"},
                     {"color_space", spaces}};
  // A file name need not be UTF-8; the sidecar must be.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::vector<std::string> map_format_names() { return {"png8", "png16", "exr"}; }

std::vector<std::string> normal_convention_names() { return {"opengl", "directx"}; }

std::vector<ExportedFile> exported_files(MapFormat format, NormalConvention normals) {
  const bool exr = format == MapFormat::exr, up = normals == NormalConvention::opengl;
  const std::string ending = extension(format);
  return {
      {"base_color" + ending, "the colour without light and shine", exr ? "linear" : "sRGB"},
      {normal_name(normals) + ending,
       up ? "slopes for OpenGL, Blender and glTF: green leans up"
          : "slopes for DirectX and Unreal: green leans down",
       "raw"},
      {"roughness" + ending, "how blurred the shine is, 0 to 1", "raw"},
      {"height" + ending,
       exr ? "heights in centimetres" : "heights from black to white; maps.json says how many cm", "raw"},
      {"render.png", "the sample as the camera would see it", "sRGB"},
      {"params.json", "the material's parameters", ""},
      {"maps.json", "size in centimetres, conventions, and where all this comes from", ""},
  };
}

void export_draw(const ExportRequest& request, const std::filesystem::path& folder,
                 const ExportProgress& progress) {
  // The maps take about as long as two images, and the render as one.
  constexpr double kParts = 8;
  double parts = 0;
  const auto made = [&](double more) {
    parts += more;
    if (progress) progress(parts / kParts);
  };
  check_resolution(request.resolution);
  const Renderer renderer(request.material, request.z_seed, request.capture);
  made(0);
  const MaterialMaps maps = request.tile ? renderer.tile(request.values, request.resolution)
                                         : renderer.maps(request.values, request.resolution);
  made(2);
  make_folder(folder);
  const Heights heights = range_of(maps.height);
  write_images(request, maps, heights, folder, [&] { made(1); });
  const Image render = renderer.render(request.values, request.resolution);
  made(1);
  write_image(folder / "render.png", render);
  write_file_atomically(folder / "params.json", params_to_json(renderer.table(), request.values));
  write_file_atomically(folder / "maps.json", sidecar(request, maps, heights));
  if (progress) progress(1);
}

}  // namespace patina
