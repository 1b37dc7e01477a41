#pragma once

#include <ATen/core/Tensor.h>

#include <filesystem>
#include <string>
#include <vector>

namespace patina {

/// A small feed-forward convolutional network, described by its file. Reflection padding, average pooling.
/// Safe to call from several threads.
class Network {
 public:
  /// Reads a .safetensors file with the architecture in its metadata (resources/networks/README.md).
  /// @throws UserError if the file is unreadable, too large, or its tensors do not fit its architecture
  static Network load(const std::filesystem::path& file);

  /// Feature maps at the layers marked for the summary, each [channels, height, width].
  /// @param image [3, n, n] float32, sRGB in [0,1]
  std::vector<at::Tensor> features(const at::Tensor& image) const;

  const std::string& name() const { return name_; }
  std::vector<std::int64_t> feature_channels() const;
  int minimum_resolution() const;

 private:
  struct Layer;
  std::string name_;
  std::vector<Layer> layers_;
};

/// The network that comes with the program.
std::filesystem::path bundled_network();

}  // namespace patina
