// Trains the network that guesses a material's parameters from a photo (README.md):
//   train-predictor MATERIAL OUT [options]
// The best network so far, by photos that it does not learn from, is in OUT at any time.
#include <ATen/Parallel.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>

#include "engine/allocator.h"
#include "engine/error.h"
#include "engine/material/registry.h"
#include "resources/predictors/photo_examples.h"
#include "resources/predictors/predictor_loss.h"
#include "resources/predictors/training.h"

namespace patina {
namespace {

struct Options {
  std::string material;
  std::filesystem::path out, data;
  int photos = 20000, held_back = 1000, threads = 2;
  std::int64_t hidden = 96;
  DenseTrainingSettings training;
};

Options parse(int argc, char** argv, CLI::App& app) {
  Options options;
  app.add_option("MATERIAL", options.material)->required();
  app.add_option("OUT", options.out, "Where to write the predictor (.safetensors)")->required();
  app.add_option("--data", options.data, "A file to keep the simulated photos in, or to take them from");
  app.add_option("--photos", options.photos, "Simulated photos to learn from")->capture_default_str();
  app.add_option("--epochs", options.training.epochs)->capture_default_str();
  app.add_option("--hidden", options.hidden, "Units of a hidden layer")->capture_default_str();
  app.add_option("--rate", options.training.rate, "Highest learning rate")->capture_default_str();
  app.add_option("--decay", options.training.decay, "Of weights")->capture_default_str();
  app.add_option("--noise", options.training.noise, "Added to features, in their sds")->capture_default_str();
  app.add_option("--seed", options.training.seed, "Of photos, first weights and batches")
      ->capture_default_str();
  app.add_option("--threads", options.threads)->capture_default_str();
  app.parse(argc, argv);
  return options;
}

PhotoExamples photos_of(const Options& options) {
  if (!options.data.empty() && std::filesystem::exists(options.data))
    return load_photo_examples(options.data);
  PhotoExamples photos = simulate_photos(options.material, options.photos + options.held_back,
                                         options.training.seed, options.threads);
  if (!options.data.empty()) save(photos, options.data);
  return photos;
}

int run(int argc, char** argv) {
  CLI::App app("Trains the network that guesses a material's parameters from a photo");
  Options options;
  try {
    options = parse(argc, argv, app);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
  at::set_num_threads(options.threads);
  const auto begin = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  const ParameterTable table = material_table(options.material);
  const PhotoExamples photos = photos_of(options);
  std::printf("%.0f s for %lld photos of %s\n", seconds(), static_cast<long long>(photos.features.size(0)),
              options.material.c_str());
  const double prior = prior_loss(table);
  DenseStudent student(photos.features, options.hidden, predictor_outputs(table), options.training.seed);
  const auto loss = [&](const at::Tensor& outputs, const at::Tensor& indices) {
    return predictor_loss(table, outputs, photos.coordinates.index_select(0, indices),
                          photos.levels.index_select(0, indices));
  };
  train(student, photos.features, options.held_back, loss, options.training,
        [&](const DenseTrainingReport& made) {
          if (made.best) write_safetensors(options.out, predictor_file(table, student));
          std::printf("epoch %2d: %.3f nats better than the prior, on photos held back %.3f%s\n", made.epoch,
                      prior - made.loss, prior - made.held_back, made.best ? " (kept)" : "");
          std::fflush(stdout);
        });
  std::printf("%.0f s in all\n", seconds());
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
