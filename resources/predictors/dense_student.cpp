#include "resources/predictors/dense_student.h"

#include <ATen/CPUGeneratorImpl.h>
#include <ATen/TensorOperators.h>
#include <ATen/ops/linear.h>
#include <ATen/ops/randn.h>
#include <ATen/ops/relu.h>
#include <ATen/ops/zeros.h>

#include <cmath>
#include <numbers>

#include "engine/prediction/dense_network.h"

namespace patina {
namespace {

constexpr double kLeastDeviation = 1e-3;  // of a feature
constexpr double kFirstOutputs = 0.1;     // begins near zero, which is the prior

}  // namespace

DenseStudent::DenseStudent(const at::Tensor& features, std::int64_t hidden, std::int64_t outputs,
                           std::uint64_t seed)
    : mean_(features.mean(0)), sd_(features.std(0).clamp_min(kLeastDeviation)) {
  at::Generator generator = at::detail::createCPUGenerator(seed);
  const auto add = [&](std::int64_t out, std::int64_t in, double gain) {
    weights_.push_back(at::randn({out, in}, generator) * (gain / std::sqrt(static_cast<double>(in))));
    biases_.push_back(at::zeros({out}));
  };
  add(hidden, features.size(1), std::numbers::sqrt2);
  add(hidden, hidden, std::numbers::sqrt2);
  add(outputs, hidden, kFirstOutputs);
  for (const at::Tensor& parameter : parameters()) parameter.requires_grad_();
}

std::vector<at::Tensor> DenseStudent::parameters() const {
  std::vector<at::Tensor> all = weights_;
  all.insert(all.end(), biases_.begin(), biases_.end());
  return all;
}

at::Tensor DenseStudent::standardised(const at::Tensor& features) const {
  return ((features - mean_) / sd_).clamp(-DenseNetwork::kFarthestFeature, DenseNetwork::kFarthestFeature);
}

at::Tensor DenseStudent::operator()(const at::Tensor& inputs) const {
  at::Tensor x = inputs;
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    x = at::linear(x, weights_[i], biases_[i]);
    if (i + 1 < weights_.size()) x = at::relu(x);
  }
  return x;
}

SafeTensors DenseStudent::to_file() const {
  SafeTensors file;
  file.tensors["feature.mean"] = mean_.contiguous();
  file.tensors["feature.sd"] = sd_.contiguous();
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    const std::string layer = "layer" + std::to_string(i + 1);
    file.tensors[layer + ".weight"] = weights_[i].detach().clone();
    file.tensors[layer + ".bias"] = biases_[i].detach().clone();
  }
  return file;
}

}  // namespace patina
