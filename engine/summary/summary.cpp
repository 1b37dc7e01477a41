#include "engine/summary/summary.h"

#include <ATen/ops/cat.h>

#include <algorithm>
#include <functional>
#include <map>
#include <ranges>

#include "engine/error.h"
#include "engine/summary/bin_means.h"
#include "engine/summary/gram.h"
#include "engine/summary/log_spectrum.h"
#include "engine/summary/summary_name.h"

namespace patina {
namespace {

using Part = std::shared_ptr<const Summary>;

/// Summaries one after the other.
class Composition final : public Summary {
 public:
  explicit Composition(std::vector<Part> parts) : parts_(std::move(parts)) {}

  at::Tensor of(const at::Tensor& images) const override {
    std::vector<at::Tensor> vectors;
    for (const Part& part : parts_) vectors.push_back(part->of(images));
    return at::cat(vectors, 1);
  }

  std::vector<SummaryBlock> blocks() const override {
    std::vector<SummaryBlock> blocks;
    for (const Part& part : parts_)
      for (const SummaryBlock& block : part->blocks()) blocks.push_back(block);
    return blocks;
  }

  int minimum_resolution() const override {
    int smallest = 1;
    for (const Part& part : parts_) smallest = std::max(smallest, part->minimum_resolution());
    return smallest;
  }

 private:
  std::vector<Part> parts_;
};

/// What "gram" and "covariances" take their network from.
struct Source {
  std::filesystem::path file;
  Precision precision;
  Device device;
  int levels = 0;  ///< of the network; 0: all
};

using MakePart = Part (*)(const Source& source);

Part of_network(const Source& source, GramMatrices::About about) {
  const std::filesystem::path file = source.file.empty() ? bundled_network() : source.file;
  return std::make_shared<GramMatrices>(Network::load(file, source.precision, source.levels, source.device),
                                        about);
}
Part gram_matrices(const Source& source) { return of_network(source, GramMatrices::About::zero); }
Part covariances(const Source& source) { return of_network(source, GramMatrices::About::mean); }
Part gram_matrices_and_covariances(const Source& source) {
  return of_network(source, GramMatrices::About::both);
}
Part ring_means(const Source&) { return std::make_shared<RingMeans>(4); }
Part fine_ring_means(const Source&) { return std::make_shared<RingMeans>(16); }
Part ring_spectrum(const Source&) { return std::make_shared<RingSpectrum>(8); }
Part strip_means(const Source&) { return std::make_shared<StripMeans>(64); }
Part column_spectrum(const Source&) { return std::make_shared<ColumnSpectrum>(16); }

struct Entry {
  const char* name;
  std::vector<MakePart> parts;
};

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all{{"gram", {gram_matrices, ring_means}},
                                      {"covariances", {covariances, ring_means}},
                                      {"rings", {fine_ring_means, ring_spectrum}},
                                      {"bands", {strip_means, column_spectrum}},
                                      {"means", {ring_means}}};
  return all;
}

const Entry& find(const std::string& name) {
  std::string known;
  for (const Entry& entry : entries()) {
    if (name == entry.name) return entry;
    known += (known.empty() ? "" : ", ") + std::string(entry.name);
  }
  throw UserError("There is no summary '" + name + "': use one of " + known +
                  ", or several joined by +, as in gram+rings; gram3 keeps three levels of the network.");
}

}  // namespace

at::Tensor Summary::operator()(const at::Tensor& image) const { return of(image.unsqueeze(0)).squeeze(0); }

int levels_of(const Summary& summary) {
  std::map<std::string, int> levels;  // "gram 1" to "gram 5", "covariances 1" to "covariances 5"
  for (const SummaryBlock& block : summary.blocks())
    if (block.scale == ErrorScale::relative) ++levels[block.name.substr(0, block.name.find(' '))];
  return levels.empty() ? 0 : std::ranges::max(levels | std::views::values);
}

std::vector<std::string> summary_names() {
  std::vector<std::string> names;
  for (const Entry& entry : entries()) names.emplace_back(entry.name);
  return names;
}

std::shared_ptr<const Summary> make_summary(const std::string& name, const std::filesystem::path& network,
                                            Precision precision, Device device) {
  std::vector<MakePart> chosen;
  Source source{network, precision, device};
  for (const std::string& named : parts_of(name)) {
    const auto [base, levels] = without_levels(named);
    if (levels > 0) source.levels = levels;
    for (const MakePart part : find(base).parts)
      if (std::ranges::find(chosen, part) == chosen.end()) chosen.push_back(part);
  }
  const auto gram = std::ranges::find(chosen, &gram_matrices),
             covariance = std::ranges::find(chosen, &covariances);
  if (gram != chosen.end() && covariance != chosen.end()) {
    *std::min(gram, covariance) = gram_matrices_and_covariances;
    chosen.erase(std::max(gram, covariance));
  }
  std::vector<Part> parts;
  for (const MakePart part : chosen) parts.push_back(part(source));
  return std::make_shared<Composition>(std::move(parts));
}

}  // namespace patina
