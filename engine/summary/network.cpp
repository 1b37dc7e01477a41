#include "engine/summary/network.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/max_pool2d.h>

#include <algorithm>

#include "engine/io/file.h"

namespace patina {

std::vector<at::Tensor> Network::features(const at::Tensor& images) const {
  at::Tensor trunk = ((images.to(mean_.device()) - mean_) / std_).contiguous(at::MemoryFormat::ChannelsLast);
  std::vector<at::Tensor> taps;
  for (const Layer& layer : layers_) {
    switch (layer.op) {
      case Op::conv:
        trunk = convolve(layer.convolutions.front(), trunk);
        break;
      case Op::avg_pool:
        trunk = average_pool(trunk);
        break;
      case Op::max_pool:
        trunk = at::max_pool2d(trunk, {2, 2});
        break;
      case Op::tap: {
        at::Tensor tap = trunk;
        for (const FrozenConvolution& convolution : layer.convolutions) tap = convolve(convolution, tap);
        taps.push_back(tap);
        break;
      }
    }
  }
  return taps;
}

std::vector<std::int64_t> Network::feature_channels() const {
  std::vector<std::int64_t> channels;
  std::int64_t trunk = 3;
  for (const Layer& layer : layers_) {
    if (layer.op == Op::conv) trunk = layer.convolutions.front().weight.size(0);
    if (layer.op == Op::tap)
      channels.push_back(layer.convolutions.empty() ? trunk : layer.convolutions.back().weight.size(0));
  }
  return channels;
}

int Network::minimum_resolution() const {
  // Reflection needs a side above the padding, at the resolution where each convolution runs.
  std::int64_t scale = 1, smallest = 2;
  for (const Layer& layer : layers_) {
    if (layer.op == Op::avg_pool || layer.op == Op::max_pool) scale *= 2;
    smallest = std::max(smallest, scale);
    for (const FrozenConvolution& convolution : layer.convolutions)
      if (convolution.reflect) smallest = std::max(smallest, scale * (convolution.weight.size(2) / 2 + 1));
  }
  return static_cast<int>(smallest);
}

std::filesystem::path bundled_network() { return data_directory() / "networks" / "bundled.safetensors"; }

}  // namespace patina
