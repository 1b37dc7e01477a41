#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <memory>
#include <vector>

#include "engine/cli/arguments.h"
#include "engine/cli/command.h"
#include "engine/io/image_file.h"
#include "engine/io/params_json.h"
#include "engine/material/renderer.h"
#include "engine/posterior/parameter_space.h"
#include "engine/run/run_checks.h"
#include "engine/run/threads.h"

namespace patina {
namespace {

struct RenderOptions {
  std::string material;
  std::filesystem::path params, out;
  std::vector<std::string> assignments, priors;
  std::uint64_t z_seed = 1;
  int resolution = 512;
  CaptureArguments capture;
  DisplayCurve curve = DisplayCurve::srgb;
};

/// The material's parameters, within the bounds of other priors, as a run's may be.
ParameterTable table_of(const Renderer& renderer, const std::vector<std::string>& priors) {
  std::map<std::string, TruncatedNormal> others;
  for (const std::string& text : priors) others.insert(parse_prior(text));
  return ParameterSpace(renderer.table(), others, {}).table();
}

int render(const RenderOptions& options) {
  use_tensor_threads(hardware_threads());
  check_material_argument(options.material);
  check_resolution(options.resolution);
  const Renderer renderer(options.material, options.z_seed, options.capture.capture());
  const ParameterTable table = table_of(renderer, options.priors);
  ParameterValues values = prior_location(table);
  if (!options.params.empty()) values = read_params(options.params, table, values);
  for (const std::string& text : options.assignments) {
    const auto [name, value] = parse_assignment("--set", text);
    set_parameter(table, name, value, values);
  }
  const bool floats = options.out.extension() == ".exr";
  write_image(options.out, renderer.render(values, options.resolution, options.curve),
              floats ? PixelDepth::f16 : PixelDepth::u8);
  return kDone;
}

}  // namespace

void add_render(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App& command = *app.add_subcommand("render", "An image of a material at given parameters");
  command.add_option("--material", options->material, "The material's name")->type_name("NAME");
  command.add_option("--params", options->params, "Parameter values; others stay at the prior's mean")
      ->type_name("FILE.json");
  command
      .add_option("--set", options->assignments, "A parameter's value, over those of --params (repeatable)")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  command
      .add_option("--prior", options->priors,
                  "Replace a parameter's prior, for values beyond its bounds (repeatable)")
      ->type_name("NAME=MEAN,SD,LOW,HIGH")
      ->allow_extra_args(false);
  command.add_option("--z-seed", options->z_seed, "Seed of the irregularities")
      ->capture_default_str()
      ->check(seed_problem);
  command.add_option("--resolution", options->resolution, "Pixels a side, 16 to 4096")->capture_default_str();
  options->capture.add_to(command);
  const std::map<std::string, DisplayCurve> curves{{"srgb", DisplayCurve::srgb},
                                                   {"gamma22", DisplayCurve::gamma22}};
  command.add_option("--curve", options->curve, "Display curve")
      ->type_name("srgb|gamma22")
      ->transform(CLI::Transformer(curves).description(""));
  command.add_option("--out", options->out, "PNG, JPEG, TIFF or EXR file to write")
      ->type_name("IMAGE")
      ->required();
  command.callback([options, &chosen] { chosen = [options] { return render(*options); }; });
}

}  // namespace patina
