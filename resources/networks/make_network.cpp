// Makes the bundled network: make-network OUT.safetensors
//
// A fixed bank of filters, applied at five scales of an image pyramid, each response split by sign into two
// rectified channels. Nothing is trained; README.md beside this file says why these filters.
#include <ATen/ops/empty.h>
#include <ATen/ops/zeros.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include "engine/summary/safetensors.h"

namespace patina {
namespace {

constexpr int kSide = 5;
constexpr int kOrientations = 4;
constexpr int kScales = 5;
constexpr double kAcross = 0.8;  // sd of an oriented filter across its edge, pixels
constexpr double kAlong = 1.4 * kAcross;
constexpr double kBlob = 1.2;        // sd of the colour filters, pixels
constexpr double kContrastGain = 4;  // oriented filters against colour ones

using Kernel = std::array<std::array<double, kSide>, kSide>;
using Colour = std::array<double, 3>;

constexpr Colour kLuminance{0.299, 0.587, 0.114};  // Rec. 601
constexpr Colour kRedGreen{1, -1, 0};
constexpr Colour kYellowBlue{0.5, 0.5, -1};

template <typename Function>
Kernel sampled(Function&& function) {
  Kernel kernel{};
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column)
      kernel[row][column] = function(column - kSide / 2, row - kSide / 2);
  return kernel;
}

template <typename Function>
void for_each(Kernel& kernel, Function&& function) {
  for (auto& row : kernel)
    for (double& value : row) function(value);
}

/// Shifted to zero mean and scaled so that a unit step at its best place gives a response near one.
Kernel as_contrast(Kernel kernel) {
  double sum = 0, magnitude = 0;
  for_each(kernel, [&](double value) { sum += value; });
  for_each(kernel, [&](double& value) { value -= sum / (kSide * kSide); });
  for_each(kernel, [&](double value) { magnitude += std::abs(value); });
  for_each(kernel, [&](double& value) { value *= 2 * kContrastGain / magnitude; });
  return kernel;
}

/// First or second derivative of a Gaussian across an edge at an angle (radians).
Kernel edge_filter(double angle, int order) {
  return as_contrast(sampled([=](double x, double y) {
    const double u = std::cos(angle) * x + std::sin(angle) * y,
                 v = -std::sin(angle) * x + std::cos(angle) * y;
    const double bell = std::exp(-u * u / (2 * kAcross * kAcross) - v * v / (2 * kAlong * kAlong));
    return (order == 1 ? -u : u * u / (kAcross * kAcross) - 1) * bell;
  }));
}

Kernel blob_filter() {
  Kernel kernel =
      sampled([](double x, double y) { return std::exp(-(x * x + y * y) / (2 * kBlob * kBlob)); });
  double sum = 0;
  for_each(kernel, [&](double value) { sum += value; });
  for_each(kernel, [&](double& value) { value /= sum; });
  return kernel;
}

/// The bank's filters as rows of [3, kSide, kSide] weights, each followed by its negative.
class Bank {
 public:
  Bank() {
    for (int i = 0; i < kOrientations; ++i)
      for (const int order : {1, 2})
        add(kLuminance, edge_filter(std::numbers::pi * i / kOrientations, order));
    for (const Colour& colour : {kRedGreen, kYellowBlue, kLuminance}) add(colour, blob_filter());
  }

  at::Tensor weights() const {
    at::Tensor tensor = at::empty(
        {static_cast<std::int64_t>(weights_.size()) / (3 * kSide * kSide), 3, kSide, kSide}, at::kFloat);
    std::copy(weights_.begin(), weights_.end(), tensor.data_ptr<float>());
    return tensor;
  }

 private:
  void add(const Colour& colour, const Kernel& kernel) {
    for (const double sign : {1.0, -1.0})
      for (const double share : colour)
        for (const auto& row : kernel)
          for (const double value : row) weights_.push_back(static_cast<float>(sign * share * value));
  }

  std::vector<float> weights_;
};

std::string description() {
  nlohmann::ordered_json layers = nlohmann::ordered_json::array();
  for (int scale = 0; scale < kScales; ++scale) {
    if (scale > 0) layers.push_back({{"op", "avg_pool"}});
    layers.push_back({{"op", "tap"}, {"weights", {"bank"}}});
  }
  const nlohmann::ordered_json network{{"format", 1},
                                       {"name", "filter bank 1"},
                                       {"mean", {0.5, 0.5, 0.5}},
                                       {"std", {0.5, 0.5, 0.5}},
                                       {"layers", layers}};
  return network.dump();
}

SafeTensors make_network() {
  SafeTensors file;
  const at::Tensor weights = Bank().weights();
  file.tensors["bank.weight"] = weights;
  file.tensors["bank.bias"] = at::zeros({weights.size(0)}, at::kFloat);
  file.metadata["patina_network"] = description();
  return file;
}

}  // namespace
}  // namespace patina

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: make-network OUT.safetensors\n", stderr);
    return 2;
  }
  try {
    patina::write_safetensors(argv[1], patina::make_network());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
