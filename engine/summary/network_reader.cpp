#include <ATen/Context.h>
#include <ATen/ops/isfinite.h>
#include <ATen/ops/tensor.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/error.h"
#include "engine/summary/network.h"
#include "engine/summary/vgg19.h"
#include "engine/summary/weights_file.h"

namespace patina {
namespace {

/// The library's name of a device, from which equal calls will get equal results.
at::Device prepared(Device device) {
  check_at_hand(device);
  if (device == Device::cpu) return at::kCPU;
  at::globalContext().setDeterministicCuDNN(true);
  at::globalContext().setAllowTF32CuDNN(false);  // whose products have 11 bits, not 24
  return at::kCUDA;
}

}  // namespace

/// Builds a Network from a file's tensors and its description, believing neither.
class NetworkReader {
 public:
  NetworkReader(const std::filesystem::path& file, Precision precision, int wanted_taps, Device device)
      : file_(file), precision_(precision), wanted_taps_(wanted_taps), device_(prepared(device)) {}

  Network read() {
    const auto json = nlohmann::json::parse(description(), nullptr, false);
    if (!json.is_object() || json.value("format", nlohmann::json()) != 1)
      refuse("its description is not of format 1");
    Network network;
    network.name_ = text(json, "name");
    network.mean_ = colour(json, "mean");
    network.std_ = colour(json, "std");
    reflect_ = padding(json) == "reflect";
    if (!json.contains("layers") || !json["layers"].is_array() || json["layers"].size() > kMaxLayers)
      refuse("its description has no list of layers");
    const std::size_t needed = needed_layers(json["layers"]);
    for (std::size_t i = 0; i < needed; ++i) network.layers_.push_back(read_layer(json["layers"][i]));
    if (taps_ == 0) refuse("its description has no tap");
    if (taps_ < wanted_taps_)
      throw UserError("The network " + file_.path().string() + " has " + std::to_string(taps_) +
                      " levels: gram" + std::to_string(wanted_taps_) + " asks for more.");
    return network;
  }

 private:
  static constexpr std::size_t kMaxLayers = 200;
  static constexpr int kMaxPools = 8;
  static constexpr std::int64_t kMaxChannels = 2048;  // of which a Gram matrix takes 16 MB
  static constexpr std::int64_t kMaxSide = 65;        // pixels, of a convolution's kernel
  static constexpr float kMinStd = 1e-3f;

  [[noreturn]] void refuse(const std::string& why) const { refuse_network(file_.path(), why); }

  std::string description() const {
    const TensorIndex& index = file_.index();
    const auto found = index.metadata.find("patina_network");
    if (found != index.metadata.end()) return found->second;
    if (looks_like_vgg(index)) return describe_vgg19(file_.path(), index);
    refuse("its metadata do not describe a network (entry patina_network), and it is no VGG-19");
  }

  /// Layers up to the last tap that is wanted.
  std::size_t needed_layers(const nlohmann::json& layers) const {
    std::size_t needed = 0;
    int taps = 0;
    for (std::size_t i = 0; i < layers.size() && (wanted_taps_ == 0 || taps < wanted_taps_); ++i)
      if (layers[i].is_object() && layers[i].value("op", nlohmann::json()) == "tap") needed = i + 1, ++taps;
    return needed == 0 ? layers.size() : needed;
  }

  std::string padding(const nlohmann::json& json) const {
    const nlohmann::json padding = json.value("padding", nlohmann::json("reflect"));
    if (padding != "reflect" && padding != "zero") refuse("its padding is neither 'reflect' nor 'zero'");
    return padding.get<std::string>();
  }

  std::string text(const nlohmann::json& json, const char* key) const {
    if (!json.is_object() || !json.contains(key) || !json[key].is_string())
      refuse(std::string("its description lacks '") + key + "'");
    return json[key];
  }

  bool relu(const nlohmann::json& layer) const {
    const nlohmann::json relu = layer.value("relu", nlohmann::json(true));
    if (!relu.is_boolean()) refuse("a layer's 'relu' is neither true nor false");
    return relu.get<bool>();
  }

  at::Tensor colour(const nlohmann::json& json, const char* key) const {
    std::vector<float> numbers;
    if (json.contains(key) && json[key].is_array() && json[key].size() == 3)
      for (const auto& number : json[key])
        if (number.is_number() && std::isfinite(number.get<float>())) numbers.push_back(number.get<float>());
    if (numbers.size() != 3) refuse(std::string("its description lacks three numbers '") + key + "'");
    if (key == std::string("std"))
      for (const float number : numbers)
        if (number < kMinStd) refuse("its std is not above " + std::to_string(kMinStd));
    return at::tensor(numbers, at::kFloat).view({1, 3, 1, 1}).to(device_);
  }

  const std::vector<std::int64_t>& shape(const std::string& name, std::size_t dimensions) const {
    const auto found = file_.index().tensors.find(name);
    if (found == file_.index().tensors.end()) refuse("tensor '" + printable(name) + "' is missing");
    if (found->second.shape.size() != dimensions)
      refuse("tensor '" + printable(name) + "' has the wrong number of dimensions");
    return found->second.shape;
  }

  /// The tensor as convolutions want it, read once, however often the description names it.
  const at::Tensor& tensor(const std::string& name) {
    at::Tensor& cached = tensors_[name];
    if (cached.defined()) return cached;
    const at::Tensor read = file_.read(name);
    if (!at::isfinite(read).all().item<bool>())
      refuse("tensor '" + printable(name) + "' has values that are not numbers");
    cached = (read.dim() == 4 ? read.contiguous(at::MemoryFormat::ChannelsLast) : read).to(device_);
    return cached;
  }

  FrozenConvolution read_convolution(const std::string& name, std::int64_t in_channels, bool relu) {
    const std::vector<std::int64_t>&weight = shape(name + ".weight", 4), &bias = shape(name + ".bias", 1);
    if (weight[1] != in_channels)
      refuse("'" + printable(name) + "' takes " + std::to_string(weight[1]) + " channels where " +
             std::to_string(in_channels) + " arrive");
    if (weight[0] > kMaxChannels)
      refuse("'" + printable(name) + "' makes more than " + std::to_string(kMaxChannels) + " channels");
    if (weight[2] != weight[3] || weight[2] % 2 == 0 || weight[2] > kMaxSide)
      refuse("'" + printable(name) + "' is not an odd square of at most " + std::to_string(kMaxSide));
    if (bias[0] != weight[0]) refuse("the bias of '" + printable(name) + "' has the wrong size");
    return {tensor(name + ".weight"), tensor(name + ".bias"), relu, reflect_, precision_};
  }

  Network::Layer read_layer(const nlohmann::json& json) {
    const std::string op = text(json, "op");
    Network::Layer layer;
    if (op == "conv") {
      layer.op = Network::Op::conv;
      layer.convolutions.push_back(read_convolution(text(json, "weights"), trunk_channels_, relu(json)));
      trunk_channels_ = layer.convolutions.front().weight.size(0);
    } else if (op == "avg_pool" || op == "max_pool") {
      layer.op = op == "avg_pool" ? Network::Op::avg_pool : Network::Op::max_pool;
      if (++pools_ > kMaxPools) refuse("it pools more than " + std::to_string(kMaxPools) + " times");
    } else if (op == "tap") {
      read_tap(json, layer);
    } else {
      refuse("its description has an unknown layer '" + printable(op) + "'");
    }
    return layer;
  }

  void read_tap(const nlohmann::json& json, Network::Layer& layer) {
    layer.op = Network::Op::tap;
    ++taps_;
    std::int64_t channels = trunk_channels_;
    const nlohmann::json names = json.value("weights", nlohmann::json::array());
    if (!names.is_array()) refuse("the weights of a tap are not a list");
    for (const auto& name : names) {
      if (!name.is_string()) refuse("the weights of a tap are not names");
      layer.convolutions.push_back(read_convolution(name, channels, /*relu=*/true));
      channels = layer.convolutions.back().weight.size(0);
    }
  }

  WeightsFile file_;
  Precision precision_;
  int wanted_taps_;
  at::Device device_;
  std::map<std::string, at::Tensor> tensors_;
  bool reflect_ = true;
  std::int64_t trunk_channels_ = 3;
  int pools_ = 0;
  int taps_ = 0;
};

Network Network::load(const std::filesystem::path& file, Precision precision, int taps, Device device) {
  return NetworkReader(file, precision, taps, device).read();
}

}  // namespace patina
