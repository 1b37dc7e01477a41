// How alike two networks rank pairs of images by their Gram distance:
//   rank-networks A B [--draws N [--first K]] [--pairs N] [--time SIDE] [IMAGE | FOLDER]...
// prints Spearman's correlation over all pairs of each folder, of N renders of prior draws of each material,
// of all images together, and, with its standard error, of N pairs of them (held_out.h). A and B are files
// that patina-cli --network takes. What an image shows is its name up to the first underscore: leather_3.jpg.
// --time prints the processor time of one thread for Gram matrices and gradient, both networks in turn.
#include <ATen/Parallel.h>
#include <ATen/TensorOperators.h>
#include <ATen/core/grad_mode.h>
#include <ATen/ops/rand.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <filesystem>

#include "engine/error.h"
#include "engine/io/photo.h"
#include "engine/summary/gram.h"
#include "engine/summary/image_tensor.h"
#include "resources/networks/gram_distance.h"
#include "resources/networks/held_out.h"
#include "resources/networks/recipe.h"

namespace patina {
namespace {

constexpr int kSide = 256;            // pixels
constexpr std::uint64_t kSeed = 500;  // of the pairs

/// Gram matrices of a set of images, by one network.
class Judge {
 public:
  Judge(const std::filesystem::path& network, const std::vector<at::Tensor>& images)
      : gram_(Network::load(network)) {
    for (const at::Tensor& image : images) summaries_.push_back(gram_(image));
  }

  std::vector<double> distances(const std::vector<Pair>& pairs) const {
    std::vector<double> distances;
    for (const auto& [i, j] : pairs)
      distances.push_back(gram_distance(summaries_[i], summaries_[j], gram_.blocks()));
    return distances;
  }

 private:
  GramMatrices gram_;
  std::vector<at::Tensor> summaries_;
};

/// Of images begin ... end - 1.
std::vector<Pair> all_pairs(std::size_t begin, std::size_t end) {
  std::vector<Pair> pairs;
  for (std::size_t i = begin; i < end; ++i)
    for (std::size_t j = begin; j < i; ++j) pairs.emplace_back(i, j);
  return pairs;
}

struct Judges {
  Judge a, b;

  void report(const std::string& name, const std::vector<Pair>& pairs) const {
    if (pairs.size() < 2) return;
    std::printf("%-40s %6zu pairs   Spearman %6.3f\n", name.c_str(), pairs.size(),
                spearman(a.distances(pairs), b.distances(pairs)));
  }

  void report_with_error(const std::vector<Pair>& pairs, std::size_t images) const {
    const std::vector<double> by_a = a.distances(pairs), by_b = b.distances(pairs);
    const auto correlation = [&](const std::vector<std::size_t>& chosen) {
      std::vector<double> x, y;
      for (const std::size_t i : chosen) x.push_back(by_a[i]), y.push_back(by_b[i]);
      return spearman(x, y);
    };
    std::printf("%-40s %6zu pairs   Spearman %6.3f +- %.3f\n", "held out, half of them of one material",
                pairs.size(), spearman(by_a, by_b), bootstrap_error(pairs, images, correlation));
  }
};

/// A run of images that are reported together.
struct Group {
  std::string name;
  std::size_t begin, end;
};

Group add_files(LabelledImages& images, const std::filesystem::path& path) {
  std::vector<std::filesystem::path> files;
  if (std::filesystem::is_directory(path)) {
    for (const auto& entry : std::filesystem::directory_iterator(path))
      if (const auto type = entry.path().extension(); type == ".png" || type == ".jpg")
        files.push_back(entry.path());
  } else {
    files.push_back(path);
  }
  std::ranges::sort(files);
  const std::size_t begin = images.images.size();
  for (const auto& file : files) {
    const std::string stem = file.stem().string();
    images.add(to_tensor(resized(load_photo(file).image, kSide)), stem.substr(0, stem.find('_')));
  }
  return {path.string(), begin, images.images.size()};
}

/// Milliseconds of processor time, one evaluation of a network's Gram matrices with the gradient by the
/// image.
double milliseconds(const GramMatrices& gram, const at::Tensor& image) {
  const std::clock_t begin = std::clock();
  const at::Tensor leaf = image.detach().requires_grad_();
  gram(leaf).square().sum().backward();
  return 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

void report_times(const std::filesystem::path& a, const std::filesystem::path& b, int side) {
  constexpr int kRepeats = 41;
  at::set_num_threads(1);
  const at::Tensor image = at::rand({3, side, side});
  const std::array networks{GramMatrices(Network::load(a)), GramMatrices(Network::load(b))};
  std::array<std::vector<double>, 2> times;
  for (int repeat = 0; repeat < kRepeats; ++repeat)
    for (std::size_t i = 0; i < networks.size(); ++i) times[i].push_back(milliseconds(networks[i], image));
  for (auto& of_one : times) std::ranges::nth_element(of_one, of_one.begin() + kRepeats / 2);
  std::printf("Gram matrices and gradient at %d pixels, median: %.1f ms and %.1f ms\n", side,
              times[0][kRepeats / 2], times[1][kRepeats / 2]);
}

int rank(int argc, char** argv) {
  CLI::App app("How alike two networks rank pairs of images by their Gram distance");
  std::filesystem::path a, b;
  std::vector<std::filesystem::path> paths;
  int draws = 0, side = 0;
  std::size_t pairs = 0;
  std::uint64_t first = 0;
  app.add_option("A", a, "A network file")->required();
  app.add_option("B", b, "Another")->required();
  app.add_option("IMAGES", paths, "Photos, or folders of them");
  app.add_option("--draws", draws, "Renders of prior draws of each material")->check(CLI::Range(0, 1000));
  app.add_option("--first", first, "Which draws: from this seed on")->check(CLI::Range(0, 1000000));
  app.add_option("--pairs", pairs, "How many pairs of all these images to draw");
  app.add_option("--time", side, "Measure speed at this resolution")->check(CLI::Range(16, 4096));
  CLI11_PARSE(app, argc, argv);

  if (side > 0) report_times(a, b, side);
  const at::NoGradGuard no_grad;
  LabelledImages images = held_out_renders(draws, kSide, first);
  std::vector<Group> groups;
  for (std::size_t i = 0; i < images.images.size(); i += static_cast<std::size_t>(draws))
    groups.push_back({"draws of " + images.materials[i], i, i + static_cast<std::size_t>(draws)});
  for (const auto& path : paths) groups.push_back(add_files(images, path));

  const Judges judges{Judge(a, images.images), Judge(b, images.images)};
  for (const Group& group : groups) judges.report(group.name, all_pairs(group.begin, group.end));
  judges.report("all", all_pairs(0, images.images.size()));
  if (pairs > 0)
    judges.report_with_error(held_out_pairs(images.materials, pairs, kSeed + first), images.images.size());
  return 0;
}

}  // namespace
}  // namespace patina

int main(int argc, char** argv) {
  try {
    return patina::rank(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
