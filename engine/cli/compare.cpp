#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "engine/cli/arguments.h"
#include "engine/cli/command.h"
#include "engine/cli/print.h"
#include "engine/cli/ranking_text.h"
#include "engine/comparison/ranking_json.h"
#include "engine/io/photo.h"

namespace patina {
namespace {

struct CompareOptions {
  std::filesystem::path photo;
  std::string crop;
  CaptureArguments capture;
  RankSettings rank;
  bool search = false, quiet = false, json = false;
};

int compare(const CompareOptions& options) {
  RankSettings settings = options.rank;
  settings.capture = options.capture.capture();
  settings.glance = !options.search;
  std::optional<PhotoCrop> crop;
  if (!options.crop.empty()) crop = parse_crop(options.crop);
  const Photo photo = load_photo(options.photo, {.crop = crop});
  if (!options.quiet)
    for (const std::string& warning : photo.warnings) std::fprintf(stderr, "%s\n", warning.c_str());
  const MaterialRanking ranking =
      rank_materials(photo.image, settings, ranking_progress(options.quiet)).value();
  options.json ? print(ranking_json(ranking)) : print(ranking_table(ranking));
  return kDone;
}

}  // namespace

void add_compare(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<CompareOptions>();
  RankSettings& rank = options->rank;
  CLI::App& command = *app.add_subcommand("compare", "Which material a photo shows: all ranked");
  command.add_option("PHOTO", options->photo, "Flash photo of a flat sample, seen from above")->required();
  command.add_option("--materials", rank.materials, "Those to compare (default: all)")
      ->type_name("NAME,...")
      ->delimiter(',');
  command.add_option("--crop", options->crop, "Square of the photo to use, as in fit")->type_name("X,Y,SIDE");
  options->capture.add_to(command);
  CLI::Option* search = command.add_flag(
      "--search", options->search,
      "By best matches and their evidence, in minutes (default: by what a trained network says at a glance)");
  command.add_option("--summary", rank.summary, "What all are compared by")
      ->type_name("NAME")
      ->capture_default_str()
      ->needs(search);
  command.add_option("--network", rank.network, "Weights of the summary's network (default: bundled)")
      ->type_name("FILE")
      ->needs(search);
  command.add_option("--resolution", rank.resolution, "Pixels a side at which renders are compared")
      ->capture_default_str()
      ->needs(search);
  command
      .add_option("--finalists", rank.finalists,
                  "So many of the best, if they are close, are measured again, with an error (0: none)")
      ->capture_default_str()
      ->check(CLI::Range(0, 100))
      ->needs(search);
  command.add_option("--threads", rank.threads, "Threads (default: all)")
      ->check(CLI::Range(1, 1024))
      ->needs(search);
  command.add_option("--seed", rank.seed, "Seed of the searches and draws")
      ->capture_default_str()
      ->check(seed_problem)
      ->needs(search);
  command.add_option("--z-seed", rank.z_seed, "Seed of the irregularities")
      ->capture_default_str()
      ->check(seed_problem)
      ->needs(search);
  command.add_flag("--quiet", options->quiet, "Print nothing but errors and the result");
  command.add_flag("--json", options->json, "As one JSON document");
  command.callback([options, &chosen] { chosen = [options] { return compare(*options); }; });
}

}  // namespace patina
