#include "tests/bench/random_vgg19.h"

#include <ATen/ops/randn.h>
#include <ATen/ops/zeros.h>

#include <cmath>
#include <string>
#include <utility>

#include "engine/summary/safetensors.h"

namespace patina {

std::vector<ConvolutionShape> vgg19_shapes(std::int64_t side) {
  std::vector<ConvolutionShape> shapes;
  std::int64_t in = 3;
  for (const auto& [count, channels] :
       std::vector<std::pair<int, std::int64_t>>{{2, 64}, {2, 128}, {4, 256}, {4, 512}, {4, 512}}) {
    for (int i = 0; i < count; ++i, in = channels) shapes.push_back({in, channels, side});
    side /= 2;
  }
  return shapes;
}

void write_random_vgg19(const std::filesystem::path& file) {
  constexpr std::int64_t kSide = 512;
  SafeTensors weights;
  int module = 0;
  std::int64_t side = kSide;
  for (const ConvolutionShape& shape : vgg19_shapes(kSide)) {
    if (shape.side != side) ++module, side = shape.side;  // a pooling
    const std::string name = "features." + std::to_string(module);
    const double sd = std::sqrt(2.0 / static_cast<double>(3 * 3 * shape.in));
    weights.tensors[name + ".weight"] = at::randn({shape.out, shape.in, 3, 3}).mul_(sd);
    weights.tensors[name + ".bias"] = at::zeros({shape.out});
    module += 2;  // with its ReLU
  }
  write_safetensors(file, weights);
}

}  // namespace patina
