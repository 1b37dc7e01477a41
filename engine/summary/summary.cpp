#include "engine/summary/summary.h"

#include <ATen/ops/cat.h>

#include <algorithm>
#include <functional>

#include "engine/error.h"
#include "engine/summary/bin_means.h"
#include "engine/summary/gram.h"
#include "engine/summary/log_spectrum.h"

namespace patina {
namespace {

using Part = std::shared_ptr<const Summary>;

/// Summaries one after the other.
class Composition final : public Summary {
 public:
  explicit Composition(std::vector<Part> parts) : parts_(std::move(parts)) {}

  at::Tensor operator()(const at::Tensor& image) const override {
    std::vector<at::Tensor> vectors;
    for (const Part& part : parts_) vectors.push_back((*part)(image));
    return at::cat(vectors);
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

using MakePart = Part (*)(const std::filesystem::path& network, Precision precision);

Part gram_matrices(const std::filesystem::path& network, Precision precision) {
  return std::make_shared<GramMatrices>(
      Network::load(network.empty() ? bundled_network() : network, precision));
}
Part ring_means(const std::filesystem::path&, Precision) { return std::make_shared<RingMeans>(4); }
Part fine_ring_means(const std::filesystem::path&, Precision) { return std::make_shared<RingMeans>(16); }
Part ring_spectrum(const std::filesystem::path&, Precision) { return std::make_shared<RingSpectrum>(8); }
Part strip_means(const std::filesystem::path&, Precision) { return std::make_shared<StripMeans>(64); }
Part column_spectrum(const std::filesystem::path&, Precision) { return std::make_shared<ColumnSpectrum>(16); }

struct Entry {
  const char* name;
  std::vector<MakePart> parts;
};

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all{{"gram", {gram_matrices, ring_means}},
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
                  ", or several joined by +, as in gram+rings.");
}

}  // namespace

std::vector<std::string> summary_names() {
  std::vector<std::string> names;
  for (const Entry& entry : entries()) names.emplace_back(entry.name);
  return names;
}

std::shared_ptr<const Summary> make_summary(const std::string& name, const std::filesystem::path& network,
                                            Precision precision) {
  std::vector<MakePart> chosen;
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::size_t end = std::min(name.find('+', begin), name.size());
    for (const MakePart part : find(name.substr(begin, end - begin)).parts)
      if (std::ranges::find(chosen, part) == chosen.end()) chosen.push_back(part);
    begin = end + 1;
  }
  std::vector<Part> parts;
  for (const MakePart part : chosen) parts.push_back(part(network, precision));
  return std::make_shared<Composition>(std::move(parts));
}

}  // namespace patina
