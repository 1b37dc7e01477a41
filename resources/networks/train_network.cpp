// Trains a small network to put images as far from each other as a large one does (README.md):
//   train-network TEACHER OUT [options]
// TEACHER is a file that patina-cli --network takes. The best network so far is in OUT at any time.
#include <ATen/Parallel.h>

#include <CLI/CLI.hpp>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "engine/allocator.h"
#include "engine/error.h"
#include "engine/summary/network.h"
#include "resources/networks/student.h"
#include "resources/networks/training.h"
#include "resources/networks/training_images.h"

namespace patina {
namespace {

struct Options {
  std::filesystem::path teacher, out, start, data;
  std::string levels = "16|32|48,48|64,64|64,64";
  std::string name = "patina-1";
  int families = 24;  // of each material at kSides[0]; half as many at kSides[1]
  int threads = 1;
  TrainingSettings training{.family = kFamilySize};
};

constexpr std::array kSides{128, 256};

Options parse(int argc, char** argv, CLI::App& app) {
  Options options;
  app.add_option("TEACHER", options.teacher, "The network to learn from")->required();
  app.add_option("OUT", options.out, "Where to write the network that learns (.safetensors)")->required();
  app.add_option("--name", options.name, "Its name")->capture_default_str();
  app.add_option("--levels", options.levels, "Channels of its convolutions, levels apart by |")
      ->capture_default_str();
  app.add_option("--start", options.start, "Go on from an earlier OUT instead");
  app.add_option("--data", options.data, "A folder to keep images and distances in, or to take them from");
  app.add_option("--families", options.families, "Families of images of each material")
      ->capture_default_str();
  app.add_option("--steps", options.training.steps)->capture_default_str();
  app.add_option("--batch", options.training.batch, "Images a step")->capture_default_str();
  app.add_option("--rate", options.training.learning_rate, "Highest learning rate")->capture_default_str();
  app.add_option("--seed", options.training.seed, "Of images, first weights and batches")
      ->capture_default_str();
  app.add_option("--threads", options.threads)->capture_default_str();
  app.parse(argc, argv);
  return options;
}

/// "16|32,48" as {{16}, {32, 48}}. @throws UserError
std::vector<std::vector<std::int64_t>> parse_levels(const std::string& text) {
  std::vector<std::vector<std::int64_t>> levels;
  std::istringstream stream(text);
  for (std::string level; std::getline(stream, level, '|');) {
    levels.emplace_back();
    std::istringstream numbers(level);
    for (std::string number; std::getline(numbers, number, ',');) {
      const bool digits =
          !number.empty() && number.size() < 5 && number.find_first_not_of("0123456789") == number.npos;
      if (!digits || std::stoi(number) == 0)
        throw UserError("Levels are numbers of channels, as in 16|32,48.");
      levels.back().push_back(std::stoi(number));
    }
  }
  return levels;
}

TrainingSet training_set(const Options& options, int side, int families) {
  const std::filesystem::path kept = options.data / ("images-" + std::to_string(side) + ".pt");
  if (!options.data.empty() && std::filesystem::exists(kept)) return load_training_set(kept);
  const auto seed = options.training.seed + static_cast<std::uint64_t>(side);
  TrainingSet set = make_training_set(training_images(families, side, seed), Network::load(options.teacher));
  if (!options.data.empty()) {
    std::filesystem::create_directories(options.data);
    save(set, kept);
  }
  return set;
}

/// Every k-th image of a set.
at::Tensor sample(const TrainingSet& set, std::int64_t count) {
  return to_unit(
      set.images.slice(0, 0, set.images.size(0), std::max<std::int64_t>(1, set.images.size(0) / count)));
}

int run(int argc, char** argv) {
  CLI::App app("Trains a small network to rank images as a large one does");
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
  std::vector<TrainingSet> sets;
  for (std::size_t i = 0; i < kSides.size(); ++i) {
    sets.push_back(training_set(options, kSides[i], options.families >> i));
    std::printf("%6.0f s  %lld images of %d pixels\n", seconds(),
                static_cast<long long>(sets.back().images.size(0)), kSides[i]);
    std::fflush(stdout);
  }
  const at::Tensor images = sample(sets[0], 64);
  Student student = options.start.empty()
                        ? Student(parse_levels(options.levels), images, options.training.seed)
                        : Student(read_safetensors(options.start));
  if (student.grams(images.slice(0, 0, 1)).size() != static_cast<std::size_t>(sets[0].distances.size(0)))
    throw UserError("A network needs as many levels as the one that it learns from has taps.");
  if (const int revived = student.revive(images, options.training.seed); revived > 0)
    std::printf("%d channels were dead and begin anew\n", revived);
  train(student, sets, options.training, [&](const TrainingReport& report) {
    std::printf("%6.0f s  step %5d  loss %.4f  Spearman", seconds(), report.step, report.loss);
    for (const double r : report.rank_correlation) std::printf(" %.4f", r);
    std::printf("%s\n", report.best ? "  *" : "");
    std::fflush(stdout);
    if (!report.best) return;
    Student balanced(student.to_file(options.name));  // a copy: Adam knows the student's own scale
    balanced.balance(images);
    write_safetensors(options.out, balanced.to_file(options.name));
  });
  Network::load(options.out);
  return 0;
}

}  // namespace
}  // namespace patina

int main(int argc, char** argv) {
  try {
    return patina::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
