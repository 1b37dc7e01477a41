#include "resources/networks/bundled_design.h"

#include <ATen/ops/zeros.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

namespace patina {
namespace {

constexpr int kLevels = 5;
constexpr int kFinerLevels = 2;      // whose texture a level sees
constexpr double kSigma = 0.6;       // pixels, of the derivatives across their direction
constexpr double kElongation = 1.4;  // of their envelope along it
constexpr double kTextureGain =
    12;  // luminance edges are weaker than colours: brings their energies together
constexpr double kTextureDecay = 0.8;  // of that gain from level to level: coarse edges are stronger
constexpr double kArrangementGain = 1.4;
constexpr double kOpponentGain = 3;  // opponent colours are weaker than brightness

constexpr int kSide = 3;
using Kernel = std::array<std::array<double, kSide>, kSide>;
using Colour = std::array<double, 3>;
constexpr Colour kLuminance{0.299, 0.587, 0.114};  // Rec. 601
constexpr std::array<Colour, 2> kOpponents{{{1, -1, 0}, {0.5, 0.5, -1}}};

/// The first (order 1) or second derivative of an elongated Gaussian across a direction, in radians: mean 0,
/// absolute sum 2.
Kernel derivative(int order, double direction) {
  Kernel kernel{};
  double sum = 0, magnitude = 0;
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) {
      const double x = column - kSide / 2, y = row - kSide / 2;
      const double across = (std::cos(direction) * x + std::sin(direction) * y) / kSigma;
      const double along = (-std::sin(direction) * x + std::cos(direction) * y) / (kElongation * kSigma);
      const double envelope = std::exp(-(across * across + along * along) / 2);
      kernel[row][column] = (order == 1 ? -across : across * across - 1) * envelope;
      sum += kernel[row][column];
    }
  for (auto& row : kernel)
    for (double& value : row) magnitude += std::abs(value -= sum / (kSide * kSide));
  for (auto& row : kernel)
    for (double& value : row) value *= 2 / magnitude;
  return kernel;
}

std::vector<Kernel> derivatives() {
  std::vector<Kernel> kernels;
  for (const int order : {1, 2})
    for (int i = 0; i <= order; ++i) kernels.push_back(derivative(order, std::numbers::pi * i / (order + 1)));
  return kernels;
}

/// A convolution that is filled in output by output.
class Convolution {
 public:
  Convolution(std::int64_t out, std::int64_t in, std::int64_t side)
      : weight_(at::zeros({out, in, side, side}, at::kFloat)), bias_(at::zeros({out}, at::kFloat)) {}

  /// The next output is one input, scaled.
  void add_copy(std::int64_t input, double gain = 1) { set_centre(next_++, input, gain); }

  /// The next two outputs are a mix of the three colours plus an offset, and its negative: between them, ReLU
  /// loses nothing.
  void add_colour(const Colour& mix, double offset) {
    for (const double sign : {1.0, -1.0}) {
      for (int c = 0; c < 3; ++c) set_centre(next_, c, sign * mix[c]);
      bias_.accessor<float, 1>()[next_++] = static_cast<float>(sign * offset);
    }
  }

  /// The next two outputs are luminance filtered by a kernel, and its negative.
  void add_texture(const Kernel& kernel, double gain) {
    auto weight = weight_.accessor<float, 4>();
    for (const double sign : {1.0, -1.0}) {
      for (int c = 0; c < 3; ++c)
        for (int row = 0; row < kSide; ++row)
          for (int column = 0; column < kSide; ++column)
            weight[next_][c][row][column] =
                static_cast<float>(sign * gain * kLuminance[c] * kernel[row][column]);
      ++next_;
    }
  }

  void move_into(SafeTensors& network, const std::string& name) && {
    network.tensors[name + ".weight"] = std::move(weight_);
    network.tensors[name + ".bias"] = std::move(bias_);
  }

 private:
  void set_centre(std::int64_t output, std::int64_t input, double value) {
    const std::int64_t centre = weight_.size(2) / 2;
    weight_.accessor<float, 4>()[output][input][centre][centre] = static_cast<float>(value);
  }

  at::Tensor weight_, bias_;
  std::int64_t next_ = 0;
};

/// The trunk of a level: colours (never negative, so that ReLU lets them pass), this level's texture, then
/// that of the finer levels, nearest first.
Convolution trunk(int level, std::int64_t in, std::int64_t finer) {
  const std::vector<Kernel> kernels = derivatives();
  Convolution convolution(3 + 2 * static_cast<std::int64_t>(kernels.size()) + finer, in, kSide);
  for (std::int64_t c = 0; c < 3; ++c) convolution.add_copy(c);
  for (const Kernel& kernel : kernels)
    convolution.add_texture(kernel, kTextureGain * std::pow(kTextureDecay, level - 1));
  for (std::int64_t i = 0; i < finer; ++i) convolution.add_copy(3 + i);
  return convolution;
}

Convolution tap(std::int64_t texture, std::int64_t finer) {
  Convolution convolution(10 + texture + finer, 3 + texture + finer, 1);
  for (const Colour& primary : {Colour{2, 0, 0}, Colour{0, 2, 0}, Colour{0, 0, 2}})
    convolution.add_colour(primary, -1);
  for (const Colour& opponent : kOpponents)
    convolution.add_colour(
        {kOpponentGain * opponent[0], kOpponentGain * opponent[1], kOpponentGain * opponent[2]}, 0);
  for (std::int64_t i = 0; i < texture; ++i) convolution.add_copy(3 + i);
  for (std::int64_t i = 0; i < finer; ++i) convolution.add_copy(3 + texture + i, kArrangementGain);
  return convolution;
}

}  // namespace

SafeTensors bundled_design() {
  const auto texture = static_cast<std::int64_t>(2 * derivatives().size());
  SafeTensors network;
  nlohmann::ordered_json layers = nlohmann::ordered_json::array();
  std::int64_t in = 3;
  for (int level = 1; level <= kLevels; ++level) {
    const std::int64_t finer = texture * std::min(level - 1, kFinerLevels);
    const std::string number = std::to_string(level);
    trunk(level, in, finer).move_into(network, "trunk" + number);
    tap(texture, finer).move_into(network, "tap" + number);
    if (level > 1) layers.push_back({{"op", "avg_pool"}});
    layers.push_back({{"op", "conv"}, {"weights", "trunk" + number}, {"relu", true}});
    layers.push_back({{"op", "tap"}, {"weights", {"tap" + number}}});
    in = 3 + texture + finer;
  }
  const std::array<double, 3> zero{0, 0, 0}, one{1, 1, 1};
  const nlohmann::ordered_json description{
      {"format", 1}, {"name", "bundled"}, {"mean", zero}, {"std", one}, {"layers", layers}};
  network.metadata["patina_network"] = description.dump();
  return network;
}

}  // namespace patina
