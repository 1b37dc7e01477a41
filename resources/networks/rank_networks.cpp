// How alike two networks rank pairs of images by their Gram distance:
//   rank-networks A B [--draws N] [IMAGE | FOLDER]...
// prints Spearman's correlation over all pairs of each folder, of N renders of prior draws of each material,
// and of all images together. A and B are files that patina-cli --network takes.
#include <ATen/core/grad_mode.h>
#include <ATen/ops/from_blob.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "engine/error.h"
#include "engine/io/photo.h"
#include "engine/material/registry.h"
#include "engine/material/renderer.h"
#include "engine/posterior/prior_transform.h"
#include "engine/sampling/rng.h"
#include "engine/summary/gram.h"
#include "resources/networks/gram_distance.h"

namespace patina {
namespace {

constexpr int kSide = 256;  // pixels

/// Gram matrices of a set of images, by one network.
class Judge {
 public:
  explicit Judge(const std::filesystem::path& network) : gram_(Network::load(network)) {}

  void add(const Image& image) {
    auto* pixels = const_cast<float*>(image.pixels.data());
    const at::Tensor tensor = at::from_blob(pixels, {kSide, kSide, 3}, at::kFloat);
    summaries_.push_back(gram_(tensor.permute({2, 0, 1}).contiguous()));
  }

  /// Of all pairs of images begin ... end - 1.
  std::vector<double> distances(std::size_t begin, std::size_t end) const {
    std::vector<double> distances;
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t j = begin; j < i; ++j)
        distances.push_back(gram_distance(summaries_[i], summaries_[j], gram_.blocks()));
    return distances;
  }

  std::size_t size() const { return summaries_.size(); }

 private:
  GramMatrices gram_;
  std::vector<at::Tensor> summaries_;
};

struct Judges {
  Judge a, b;

  void add(const Image& image) {
    const Image square = resized(image, kSide);
    a.add(square);
    b.add(square);
  }

  void report(const std::string& name, std::size_t begin) const {
    const std::vector<double> by_a = a.distances(begin, a.size()), by_b = b.distances(begin, b.size());
    std::printf("%-40s %4zu images %6zu pairs   Spearman %6.3f\n", name.c_str(), a.size() - begin,
                by_a.size(), spearman(by_a, by_b));
  }
};

void add_images(Judges& judges, const std::filesystem::path& path) {
  if (!std::filesystem::is_directory(path)) return judges.add(load_photo(path).image);
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(path))
    if (const auto type = entry.path().extension(); type == ".png" || type == ".jpg")
      files.push_back(entry.path());
  std::ranges::sort(files);
  for (const auto& file : files) judges.add(load_photo(file).image);
}

void add_draws(Judges& judges, const std::string& material, int draws) {
  for (int draw = 0; draw < draws; ++draw) {
    Rng rng(static_cast<std::uint64_t>(draw));
    const Renderer renderer(material, static_cast<std::uint64_t>(draw) + 1, Capture{});
    ParameterValues values;
    for (const Parameter& parameter : renderer.table().continuous)
      values.continuous.push_back(PriorTransform(parameter.prior).value(rng.normal()));
    for (const DiscreteParameter& parameter : renderer.table().discrete)
      values.discrete.push_back(rng.below(static_cast<int>(parameter.levels.size())));
    judges.add(renderer.render(values, kSide));
  }
}

int rank(int argc, char** argv) {
  CLI::App app("How alike two networks rank pairs of images by their Gram distance");
  std::filesystem::path a, b;
  std::vector<std::filesystem::path> paths;
  int draws = 0;
  app.add_option("A", a, "A network file")->required();
  app.add_option("B", b, "Another")->required();
  app.add_option("IMAGES", paths, "Photos, or folders of them");
  app.add_option("--draws", draws, "Renders of prior draws of each material")->check(CLI::Range(0, 1000));
  CLI11_PARSE(app, argc, argv);

  const at::NoGradGuard no_grad;
  Judges judges{Judge(a), Judge(b)};
  for (const auto& path : paths) {
    const std::size_t begin = judges.a.size();
    add_images(judges, path);
    if (judges.a.size() > begin + 1) judges.report(path.string(), begin);
  }
  for (const std::string& material : material_names()) {
    const std::size_t begin = judges.a.size();
    add_draws(judges, material, draws);
    if (draws > 1) judges.report("draws of " + material, begin);
  }
  judges.report("all", 0);
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
