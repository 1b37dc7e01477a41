#pragma once

#include <ATen/core/Tensor.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/summary/device.h"
#include "engine/summary/feature_steps.h"

namespace patina {

/// A small feed-forward convolutional network, described by its file. Safe to call from several threads.
///
/// The file is a .safetensors file of float32 tensors whose metadata entry "patina_network" is JSON:
///   {"format": 1, "name": "...", "mean": [r, g, b], "std": [r, g, b], "padding": "reflect", "layers": [...]}
/// The input, sRGB in [0,1], is normalised to (x - mean) / std. Layers run in order on a trunk, up to the
/// last tap; what lies behind it is neither read nor run:
///   {"op": "conv", "weights": "NAME", "relu": true}
///       trunk = [ReLU] conv(trunk) with NAME.weight [out, in, k, k], k odd, and NAME.bias [out]; padding, by
///       reflection ("reflect", the default) or with zeros ("zero"), keeps the size
///   {"op": "avg_pool"} or {"op": "max_pool"}
///       2 x 2, stride 2; an odd last row or column is dropped
///   {"op": "tap", "weights": ["NAME", ...]}
///       one feature map of the summary: the trunk as it is, or the trunk sent through those convolutions,
///       each with ReLU, aside
/// Or it is VGG-19 as torchvision or timm publish it (vgg19.h): a state dict as PyTorch checkpoint or
/// .safetensors.
class Network {
 public:
  /// Reads only the tensors that its taps need, and rounds their weights to a precision.
  /// @param taps    how many of its taps to keep, the first ones; 0: all
  /// @param device  to keep the weights on
  /// @throws UserError if the file is unreadable, too large, or its tensors do not fit its architecture, if
  /// it
  ///                   has fewer taps, or if the device is not at hand
  static Network load(const std::filesystem::path& file, Precision precision = Precision::float32,
                      int taps = 0, Device device = Device::cpu);

  /// The feature maps of the taps, each [k, channels, height, width] on the network's device, of several
  /// images in one pass.
  /// @param images [k, 3, n, n] float32, sRGB in [0,1], n >= minimum_resolution(), on any device
  std::vector<at::Tensor> features(const at::Tensor& images) const;

  const std::string& name() const { return name_; }
  std::vector<std::int64_t> feature_channels() const;
  int minimum_resolution() const;

 private:
  enum class Op { conv, avg_pool, max_pool, tap };
  struct Layer {
    Op op = Op::tap;
    std::vector<FrozenConvolution> convolutions;
  };
  friend class NetworkReader;

  std::string name_;
  at::Tensor mean_, std_;  ///< [1, 3, 1, 1], on its device
  std::vector<Layer> layers_;
};

/// The network that comes with the program.
std::filesystem::path bundled_network();

}  // namespace patina
