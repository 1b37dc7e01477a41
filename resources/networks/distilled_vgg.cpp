#include "resources/networks/distilled_vgg.h"

#include <array>
#include <nlohmann/json.hpp>
#include <string>

#include "engine/error.h"

namespace patina {
namespace {

constexpr std::array kConvolutionsOfBlock{2, 2, 4, 4, 1};

}  // namespace

SafeTensors describe_distilled_vgg(SafeTensors weights) {
  nlohmann::ordered_json layers = nlohmann::ordered_json::array();
  const auto known = [&](const std::string& name) {
    if (!weights.tensors.contains(name + ".weight"))
      throw UserError("There is no tensor " + name +
                      ".weight: give the distilled VGG-19's safetensors file.");
    return name;
  };
  layers.push_back({{"op", "conv"}, {"weights", known("conv0")}, {"relu", false}});
  for (std::size_t block = 1; block <= kConvolutionsOfBlock.size(); ++block) {
    if (block > 1) layers.push_back({{"op", "max_pool"}});
    for (int i = 1; i <= kConvolutionsOfBlock[block - 1]; ++i) {
      const std::string name = known("conv" + std::to_string(block) + std::to_string(i));
      layers.push_back({{"op", "conv"}, {"weights", name}, {"relu", true}});
      if (i == 1) layers.push_back({{"op", "tap"}, {"weights", {known(name + "_aux")}}});
    }
  }
  const std::array<double, 3> zero{0, 0, 0}, one{1, 1, 1};
  weights.metadata["patina_network"] = nlohmann::ordered_json{
      {"format", 1},
      {"name", "distilled VGG-19"},
      {"mean", zero},
      {"std", one},
      {"layers", layers}}.dump();
  return weights;
}

}  // namespace patina
