#include "resources/networks/student.h"

#include <ATen/CPUGeneratorImpl.h>
#include <ATen/TensorOperators.h>
#include <ATen/core/grad_mode.h>
#include <ATen/ops/avg_pool2d.h>
#include <ATen/ops/bmm.h>
#include <ATen/ops/conv2d.h>
#include <ATen/ops/linalg_vector_norm.h>
#include <ATen/ops/nonzero.h>
#include <ATen/ops/randn.h>
#include <ATen/ops/reflection_pad2d.h>
#include <ATen/ops/relu.h>
#include <ATen/ops/zeros.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/error.h"

namespace patina {
namespace {

// sRGB values are brought to about zero mean and unit variance.
constexpr double kMean = 0.5, kStd = 0.25;

at::Tensor normalised(const at::Tensor& images) {
  return ((images - kMean) / kStd).contiguous(at::MemoryFormat::ChannelsLast);
}

at::Tensor per_channel(const at::Tensor& x) { return x.view({-1, 1, 1, 1}); }

constexpr double kAlive = 1e-3;  // share of pixels at which a channel is on

at::Tensor random_filters(std::int64_t out, std::int64_t in, at::Generator& generator) {
  return at::randn({out, in, 3, 3}, generator) * std::sqrt(2.0 / (9.0 * static_cast<double>(in)));
}

/// What brings a response [b, c, n, n] to mean 0 and variance 1 in every channel: x / sd - mean / sd.
struct Standardisation {
  at::Tensor scale, shift;
};

Standardisation standardise(const at::Tensor& response) {
  const at::Tensor mean = response.mean({0, 2, 3}), sd = response.std({0, 2, 3}).clamp_min(1e-3);
  return {1 / sd, -mean / sd};
}

std::string tensor_name(std::size_t level, std::size_t convolution) {
  return "level" + std::to_string(level + 1) + "." + std::to_string(convolution + 1);
}

}  // namespace

at::Tensor Student::Convolution::operator()(const at::Tensor& x) const {
  return at::conv2d(at::reflection_pad2d(x, {1, 1, 1, 1}), weight, bias);
}

Student::Student(const std::vector<std::vector<std::int64_t>>& levels, const at::Tensor& images,
                 std::uint64_t seed) {
  const at::NoGradGuard no_grad;
  at::Generator generator = at::detail::createCPUGenerator(seed);
  at::Tensor trunk = normalised(images);
  for (const std::vector<std::int64_t>& level : levels) {
    if (!levels_.empty()) trunk = at::avg_pool2d(trunk, {2, 2});
    levels_.emplace_back();
    for (const std::int64_t out : level) {
      const std::int64_t in = trunk.size(1);
      at::Tensor weight = random_filters(out, in, generator);
      if (in == 3)
        for (std::int64_t i = 0; i < out; i += 2) weight[i] -= weight[i].mean({1, 2}, /*keepdim=*/true);
      const Standardisation to = standardise(Convolution{weight, at::zeros({out})}(trunk));
      levels_.back().push_back({weight * per_channel(to.scale), to.shift});
      trunk = at::relu(levels_.back().back()(trunk));
    }
  }
  for (const at::Tensor& parameter : parameters()) parameter.requires_grad_();
}

Student::Student(const SafeTensors& file) {
  const auto has = [&](std::size_t level, std::size_t i) {
    return file.tensors.contains(tensor_name(level, i) + ".weight");
  };
  for (std::size_t level = 0; has(level, 0); ++level) {
    levels_.emplace_back();
    for (std::size_t i = 0; has(level, i); ++i)
      levels_.back().push_back({file.tensors.at(tensor_name(level, i) + ".weight"),
                                file.tensors.at(tensor_name(level, i) + ".bias")});
  }
  if (levels_.empty()) throw UserError("This is no network that train-network wrote.");
  for (const at::Tensor& parameter : parameters()) parameter.requires_grad_();
}

std::vector<at::Tensor> Student::parameters() const {
  std::vector<at::Tensor> all;
  for (const auto& level : levels_)
    for (const Convolution& convolution : level) {
      all.push_back(convolution.weight);
      all.push_back(convolution.bias);
    }
  return all;
}

std::vector<at::Tensor> Student::grams(const at::Tensor& images) const {
  std::vector<at::Tensor> grams;
  at::Tensor trunk = normalised(images);
  for (std::size_t level = 0; level < levels_.size(); ++level) {
    if (level > 0) trunk = at::avg_pool2d(trunk, {2, 2});
    for (const Convolution& convolution : levels_[level]) trunk = at::relu(convolution(trunk));
    const at::Tensor flat = trunk.permute({0, 2, 3, 1}).flatten(1, 2);  // [b, pixels, c]
    const double pixels = static_cast<double>(flat.size(1));
    grams.push_back((at::bmm(flat.transpose(1, 2), flat) / pixels).flatten(1));
  }
  return grams;
}

int Student::revive(const at::Tensor& images, std::uint64_t seed) {
  const at::NoGradGuard no_grad;
  at::Generator generator = at::detail::createCPUGenerator(seed);
  at::Tensor trunk = normalised(images), revived;
  int count = 0;
  for (std::size_t level = 0; level < levels_.size(); ++level) {
    if (level > 0) trunk = at::avg_pool2d(trunk, {2, 2});
    for (Convolution& convolution : levels_[level]) {
      if (revived.defined()) convolution.weight.index_fill_(1, revived, 0);
      const at::Tensor response = convolution(trunk);
      revived = at::nonzero((response > 0).to(at::kFloat).mean({0, 2, 3}) < kAlive).flatten();
      const double size = response.std({0, 2, 3}).median().item<double>();
      if (const std::int64_t dead = revived.size(0); dead > 0) {
        const at::Tensor weight = random_filters(dead, trunk.size(1), generator);
        const Standardisation to = standardise(Convolution{weight, at::zeros({dead})}(trunk));
        convolution.weight.index_copy_(0, revived, size * weight * per_channel(to.scale));
        convolution.bias.index_copy_(0, revived, size * to.shift);
        count += static_cast<int>(dead);
      }
      trunk = at::relu(convolution(trunk));
    }
  }
  return count;
}

void Student::balance(const at::Tensor& images) {
  const at::NoGradGuard no_grad;
  double before = 1;  // what the features that arrive at a level have been multiplied by
  const std::vector<at::Tensor> grams = this->grams(images);
  for (std::size_t level = 0; level < levels_.size(); ++level) {
    const double norm =
        at::linalg_vector_norm(grams[level], 2, at::OptionalIntArrayRef({1})).mean().item<double>();
    const double after = 1 / std::sqrt(norm);
    for (std::size_t i = 0; i < levels_[level].size(); ++i) {
      const Convolution& convolution = levels_[level][i];
      convolution.weight.mul_(i == 0 ? after / before : 1);
      convolution.bias.mul_(after);
    }
    before = after;
  }
}

SafeTensors Student::to_file(const std::string& name) const {
  SafeTensors file;
  nlohmann::ordered_json layers = nlohmann::ordered_json::array();
  for (std::size_t level = 0; level < levels_.size(); ++level) {
    if (level > 0) layers.push_back({{"op", "avg_pool"}});
    for (std::size_t i = 0; i < levels_[level].size(); ++i) {
      const std::string weights = tensor_name(level, i);
      file.tensors[weights + ".weight"] = levels_[level][i].weight.detach().clone();
      file.tensors[weights + ".bias"] = levels_[level][i].bias.detach().clone();
      layers.push_back({{"op", "conv"}, {"weights", weights}, {"relu", true}});
    }
    layers.push_back({{"op", "tap"}, {"weights", nlohmann::ordered_json::array()}});
  }
  const std::array<double, 3> mean{kMean, kMean, kMean}, std{kStd, kStd, kStd};
  file.metadata["patina_network"] =
      nlohmann::ordered_json{{"format", 1}, {"name", name}, {"mean", mean}, {"std", std}, {"layers", layers}}
          .dump();
  return file;
}

}  // namespace patina
