#include "tests/summary/naive.h"

#include <algorithm>
#include <cstdlib>

namespace patina::naive {
namespace {

std::int64_t reflected(std::int64_t i, std::int64_t size) {
  i = std::abs(i);
  return i < size ? i : 2 * (size - 1) - i;
}

template <typename Pixel>
Maps make(std::int64_t channels, std::int64_t height, std::int64_t width, Pixel&& pixel) {
  Maps maps{channels, height, width, {}};
  for (std::int64_t c = 0; c < channels; ++c)
    for (std::int64_t row = 0; row < height; ++row)
      for (std::int64_t column = 0; column < width; ++column) maps.values.push_back(pixel(c, row, column));
  return maps;
}

}  // namespace

Maps from_tensor(const at::Tensor& tensor) {
  const at::Tensor plain = tensor.detach().contiguous();
  const float* values = plain.data_ptr<float>();
  return {plain.size(0), plain.size(1), plain.size(2), {values, values + plain.numel()}};
}

Maps normalised(const Maps& image, const double (&mean)[3], const double (&std)[3]) {
  return make(3, image.height, image.width, [&](std::int64_t c, std::int64_t row, std::int64_t column) {
    return (image.at(c, row, column) - mean[c]) / std[c];
  });
}

Maps convolved(const Maps& in, const SafeTensors& network, const std::string& name, bool relu, bool reflect) {
  const at::Tensor& weight = network.tensors.at(name + ".weight");
  const float* bias = network.tensors.at(name + ".bias").data_ptr<float>();
  const float* w = weight.data_ptr<float>();
  const std::int64_t side = weight.size(2);
  const auto pixel = [&](std::int64_t c, std::int64_t row, std::int64_t column) {
    const bool inside = row >= 0 && row < in.height && column >= 0 && column < in.width;
    if (!inside && !reflect) return 0.0;
    return in.at(c, reflected(row, in.height), reflected(column, in.width));
  };
  return make(weight.size(0), in.height, in.width,
              [&](std::int64_t out, std::int64_t row, std::int64_t column) {
                double sum = bias[out];
                for (std::int64_t c = 0; c < in.channels; ++c)
                  for (std::int64_t i = 0; i < side; ++i)
                    for (std::int64_t j = 0; j < side; ++j)
                      sum += w[((out * in.channels + c) * side + i) * side + j] *
                             pixel(c, row + i - side / 2, column + j - side / 2);
                return relu ? std::max(sum, 0.0) : sum;
              });
}

Maps average_pooled(const Maps& in) {
  return make(in.channels, in.height / 2, in.width / 2,
              [&](std::int64_t c, std::int64_t row, std::int64_t column) {
                return (in.at(c, 2 * row, 2 * column) + in.at(c, 2 * row, 2 * column + 1) +
                        in.at(c, 2 * row + 1, 2 * column) + in.at(c, 2 * row + 1, 2 * column + 1)) /
                       4;
              });
}

Maps max_pooled(const Maps& in) {
  return make(in.channels, in.height / 2, in.width / 2,
              [&](std::int64_t c, std::int64_t row, std::int64_t column) {
                return std::max({in.at(c, 2 * row, 2 * column), in.at(c, 2 * row, 2 * column + 1),
                                 in.at(c, 2 * row + 1, 2 * column), in.at(c, 2 * row + 1, 2 * column + 1)});
              });
}

std::vector<double> gram(const Maps& features) {
  const auto pixels = static_cast<std::size_t>(features.height * features.width);
  std::vector<double> gram;
  for (std::int64_t i = 0; i < features.channels; ++i)
    for (std::int64_t j = 0; j < features.channels; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < pixels; ++k)
        sum += features.values[static_cast<std::size_t>(i) * pixels + k] *
               features.values[static_cast<std::size_t>(j) * pixels + k];
      gram.push_back(sum / static_cast<double>(pixels));
    }
  return gram;
}

}  // namespace patina::naive
