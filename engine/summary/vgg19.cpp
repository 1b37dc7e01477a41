#include "engine/summary/vgg19.h"

#include <nlohmann/json.hpp>

namespace patina {
namespace {

struct Block {
  int convolutions;
  std::int64_t channels;
};

constexpr Block kBlocks[] = {{2, 64}, {2, 128}, {4, 256}, {4, 512}, {4, 512}};

void check(const std::filesystem::path& file, const TensorIndex& index, const std::string& name,
           const std::vector<std::int64_t>& shape) {
  const auto found = index.tensors.find(name);
  if (found == index.tensors.end())
    refuse_network(file, "it is no VGG-19 of torchvision or timm, for tensor '" + name + "' is missing");
  if (found->second.shape != shape)
    refuse_network(file,
                   "it is no VGG-19 of torchvision or timm, for tensor '" + name + "' has another shape");
}

}  // namespace

bool looks_like_vgg(const TensorIndex& index) { return index.tensors.contains("features.0.weight"); }

std::string describe_vgg19(const std::filesystem::path& file, const TensorIndex& index) {
  auto layers = nlohmann::ordered_json::array();
  std::int64_t in = 3;
  int module = 0;  // torchvision counts convolutions, ReLUs and poolings
  for (const auto& [convolutions, channels] : kBlocks) {
    if (module > 0) {
      layers.push_back({{"op", "avg_pool"}});
      ++module;
    }
    for (int i = 0; i < convolutions; ++i) {
      const std::string name = "features." + std::to_string(module);
      check(file, index, name + ".weight", {channels, in, 3, 3});
      check(file, index, name + ".bias", {channels});
      layers.push_back({{"op", "conv"}, {"weights", name}, {"relu", true}});
      in = channels;
      module += 2;
    }
    layers.push_back({{"op", "tap"}});
  }
  return nlohmann::ordered_json{{"format", 1},
                                {"name", "VGG-19"},
                                {"mean", {0.485, 0.456, 0.406}},
                                {"std", {0.229, 0.224, 0.225}},
                                {"padding", "reflect"},
                                {"layers", layers}}
      .dump();
}

}  // namespace patina
