#include "engine/summary/summary.h"

#include <ATen/ops/cat.h>

#include <algorithm>

#include "engine/error.h"
#include "engine/summary/gram.h"
#include "engine/summary/network.h"
#include "engine/summary/ring_means.h"

namespace patina {
namespace {

/// "means": the mean colours of concentric rings alone.
class MeansSummary final : public Summary {
 public:
  at::Tensor operator()(const at::Tensor& image) const override { return rings_(image); }
  std::vector<SummaryBlock> blocks() const override { return {{"ring means", 3 * RingMeans::kRings, false}}; }
  int minimum_resolution() const override { return 2 * RingMeans::kRings; }

 private:
  RingMeans rings_;
};

/// "gram": Gram matrices of a network's features and ring means (paper section 4, "Neural summary function").
class GramSummary final : public Summary {
 public:
  explicit GramSummary(Network network) : network_(std::move(network)) {}

  at::Tensor operator()(const at::Tensor& image) const override {
    std::vector<at::Tensor> parts;
    for (const at::Tensor& features : network_.features(image)) parts.push_back(gram_vector(features));
    parts.push_back(means_(image));
    return at::cat(parts);
  }

  std::vector<SummaryBlock> blocks() const override {
    std::vector<SummaryBlock> blocks;
    for (const std::int64_t channels : network_.feature_channels())
      blocks.push_back({"gram " + std::to_string(blocks.size() + 1), channels * (channels + 1) / 2, true});
    for (const SummaryBlock& block : means_.blocks()) blocks.push_back(block);
    return blocks;
  }

  int minimum_resolution() const override {
    return std::max(network_.minimum_resolution(), means_.minimum_resolution());
  }

 private:
  Network network_;
  MeansSummary means_;
};

}  // namespace

std::vector<std::string> summary_names() { return {"gram", "means"}; }

std::shared_ptr<const Summary> make_summary(const std::string& name, const std::filesystem::path& network) {
  if (name == "means") return std::make_shared<MeansSummary>();
  if (name == "gram")
    return std::make_shared<GramSummary>(Network::load(network.empty() ? bundled_network() : network));
  throw UserError("There is no summary '" + name + "': use gram or means.");
}

}  // namespace patina
