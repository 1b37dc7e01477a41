#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>

#include "engine/cli/command.h"
#include "engine/cli/draw_choice.h"
#include "engine/cli/draws_csv.h"
#include "engine/error.h"
#include "engine/io/file.h"
#include "engine/io/params_json.h"
#include "engine/run/export_draw.h"
#include "engine/run/manifest.h"
#include "engine/run/run.h"
#include "engine/run/threads.h"

namespace patina {
namespace {

struct ExportOptions {
  std::filesystem::path directory, out;
  std::string draw = "map", format;
  int resolution = 1024;
  bool tile = false;
  std::string image = "png16", normal = "opengl";
};

std::size_t place_in(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

ExportRequest request_of(const ExportOptions& options, const DrawSource& run, const ParameterValues& values) {
  const RunSettings& settings = run.settings();
  ExportRequest request{settings.material,  settings.z_seed, settings.capture, values,
                        options.resolution, options.tile};
  request.format = static_cast<MapFormat>(place_in(map_format_names(), options.image));
  request.normals = static_cast<NormalConvention>(place_in(normal_convention_names(), options.normal));
  request.origin.photo_sha256 = read_manifest(options.directory).photo_sha256;
  request.origin.run = std::filesystem::absolute(options.directory).lexically_normal().filename();
  request.origin.draw = options.draw;
  return request;
}

int export_run(const ExportOptions& options) {
  if (options.tile && options.format != "maps")
    throw UserError("--tile is about maps: give it with --format maps.");
  const auto run = open_run(options.directory);
  const std::vector<Draw> draws = run->take_draws();
  if (options.format == "csv") {
    write_file_atomically(options.out, draws_csv(run->table(), draws));
    return kDone;
  }
  const ParameterValues values = choose_draw(options.draw, *run, draws);
  if (options.format == "json") {
    write_file_atomically(options.out, params_to_json(run->table(), values));
    return kDone;
  }
  use_tensor_threads(hardware_threads());
  export_draw(request_of(options, *run, values), options.out);
  return kDone;
}

}  // namespace

void add_export(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App& command = *app.add_subcommand("export", "A draw of a run, as parameters or as texture maps");
  command.add_option("RUN_DIR", options->directory, "A run directory, also one that still grows")->required();
  command
      .add_option("--draw", options->draw,
                  "The best match, the posterior mean, or a draw by chain and number, both from 1")
      ->type_name("map|mean|CHAIN:DRAW")
      ->capture_default_str();
  command
      .add_option("--format", options->format,
                  "json: the draw's parameters; maps: a folder of textures, render and parameters; "
                  "csv: all draws after warm-up")
      ->type_name("json|maps|csv")
      ->check(CLI::IsMember({"json", "maps", "csv"}).description(""))
      ->required();
  command.add_option("--resolution", options->resolution, "Pixels a side of maps, 16 to 4096")
      ->capture_default_str();
  command
      .add_option("--image", options->image, "Images of maps: png8, png16, or exr (linear, heights in cm)")
      ->type_name("png8|png16|exr")
      ->check(CLI::IsMember(map_format_names()).description(""))
      ->capture_default_str();
  command
      .add_option("--normal", options->normal,
                  "Normal map: opengl (green up; Blender, glTF), directx (green down; Unreal)")
      ->type_name("opengl|directx")
      ->check(CLI::IsMember(normal_convention_names()).description(""))
      ->capture_default_str();
  command.add_flag(
      "--tile", options->tile,
      "Maps that repeat without a seam; they may show more than the sample: maps.json has their size");
  command.add_option("--out", options->out, "File to write; for maps a folder")
      ->type_name("PATH")
      ->required();
  command.callback([options, &chosen] { chosen = [options] { return export_run(*options); }; });
}

}  // namespace patina
