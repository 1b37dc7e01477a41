#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "engine/cli/command.h"
#include "engine/cli/draw_choice.h"
#include "engine/cli/draws_csv.h"
#include "engine/error.h"
#include "engine/io/file.h"
#include "engine/io/params_json.h"
#include "engine/run/export_draw.h"
#include "engine/run/run.h"
#include "engine/run/threads.h"

namespace patina {
namespace {

struct Options {
  std::filesystem::path directory, out;
  std::string draw = "map", format;
  int resolution = 1024;
  bool tile = false;
};

int export_run(const Options& options) {
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
  const RunSettings& settings = run->settings();
  export_draw(
      {settings.material, settings.z_seed, settings.capture, values, options.resolution, options.tile},
      options.out);
  return kDone;
}

}  // namespace

void add_export(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<Options>();
  CLI::App& command = *app.add_subcommand("export", "A draw of a run, as parameters or as texture maps");
  command.add_option("RUN_DIR", options->directory, "A run directory, also one that still grows")->required();
  command
      .add_option("--draw", options->draw,
                  "The best match, the posterior mean, or a draw by chain and number, both from 1")
      ->type_name("map|mean|CHAIN:DRAW")
      ->capture_default_str();
  command
      .add_option("--format", options->format,
                  "json: the draw's parameters; maps: a folder of 16-bit textures, render and parameters; "
                  "csv: all draws after warm-up")
      ->type_name("json|maps|csv")
      ->check(CLI::IsMember({"json", "maps", "csv"}).description(""))
      ->required();
  command.add_option("--resolution", options->resolution, "Pixels a side of maps, 16 to 4096")
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
