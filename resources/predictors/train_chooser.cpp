// Trains the network that guesses which material a photo shows (README.md):
//   train-chooser OUT [options]
// The best network so far, by photos that it does not learn from, is in OUT at any time.
#include <ATen/CPUGeneratorImpl.h>
#include <ATen/Parallel.h>
#include <ATen/TensorOperators.h>
#include <ATen/ops/cat.h>
#include <ATen/ops/cross_entropy_loss.h>
#include <ATen/ops/full.h>
#include <ATen/ops/randperm.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/allocator.h"
#include "engine/error.h"
#include "engine/material/registry.h"
#include "resources/predictors/chooser_file.h"
#include "resources/predictors/photo_examples.h"
#include "resources/predictors/training.h"

namespace patina {
namespace {

struct Options {
  std::filesystem::path out, data;
  std::int64_t hidden = 64, held_back = 1500;
  int photos = 1500, threads = 2;
  DenseTrainingSettings training{.epochs = 20, .noise = 0.3};
};

Options parse(int argc, char** argv, CLI::App& app) {
  Options options;
  app.add_option("OUT", options.out, "Where to write the network (.safetensors)")->required();
  app.add_option("--data", options.data, "A folder to keep the simulated photos in, or to take them from");
  app.add_option("--photos", options.photos, "Simulated photos of each material")->capture_default_str();
  app.add_option("--epochs", options.training.epochs)->capture_default_str();
  app.add_option("--hidden", options.hidden, "Units of a hidden layer")->capture_default_str();
  app.add_option("--decay", options.training.decay, "Of weights")->capture_default_str();
  app.add_option("--noise", options.training.noise, "Added to features, in their sds")->capture_default_str();
  app.add_option("--seed", options.training.seed, "Of photos, first weights and batches")
      ->capture_default_str();
  app.add_option("--threads", options.threads)->capture_default_str();
  app.parse(argc, argv);
  if (!options.data.empty()) std::filesystem::create_directories(options.data);
  return options;
}

PhotoExamples photos_of(const Options& options, const std::string& material) {
  const std::filesystem::path kept = options.data / ("varied-" + material + ".pt");
  if (!options.data.empty() && std::filesystem::exists(kept)) return load_photo_examples(kept);
  PhotoExamples photos =
      simulate_photos(material, options.photos, options.training.seed, options.threads, /*varied=*/true);
  if (!options.data.empty()) save(photos, kept);
  return photos;
}

/// Photos of all materials in random order, and which material each is of.
struct Examples {
  at::Tensor features, materials;
};

Examples examples(const Options& options) {
  std::vector<at::Tensor> features, materials;
  for (const std::string& name : material_names()) {
    features.push_back(photos_of(options, name).features);
    materials.push_back(at::full({features.back().size(0)}, std::ssize(materials), at::kLong));
  }
  const at::Tensor all = at::cat(features);
  at::Generator generator = at::detail::createCPUGenerator(options.training.seed);
  const at::Tensor order = at::randperm(all.size(0), generator, at::kLong);
  return {all.index_select(0, order), at::cat(materials).index_select(0, order)};
}

int run(int argc, char** argv) {
  CLI::App app("Trains the network that guesses which material a photo shows");
  Options options;
  try {
    options = parse(argc, argv, app);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
  at::set_num_threads(options.threads);
  const Examples all = examples(options);
  if (all.features.size(0) <= options.held_back)
    throw UserError(std::to_string(options.held_back) + " photos are held back: ask for more --photos.");
  DenseStudent student(all.features, options.hidden, std::ssize(material_names()), options.training.seed);
  const auto loss = [&](const at::Tensor& outputs, const at::Tensor& indices) {
    return at::cross_entropy_loss(outputs, all.materials.index_select(0, indices));
  };
  train(student, all.features, options.held_back, loss, options.training,
        [&](const DenseTrainingReport& made) {
          if (made.best) write_safetensors(options.out, chooser_file(student));
          std::printf("epoch %2d: loss %.4f, on photos held back %.4f%s\n", made.epoch, made.loss,
                      made.held_back, made.best ? " (kept)" : "");
          std::fflush(stdout);
        });
  return 0;
}

}  // namespace
}  // namespace patina

int main(int argc, char** argv) {
  try {
    return patina::run(argc, argv);
  } catch (const patina::UserError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
