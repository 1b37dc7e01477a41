#include "tests/summary/network_files.h"

#include <ATen/ops/empty.h>

#include <random>

namespace patina {

at::Tensor random_tensor(at::IntArrayRef shape, unsigned seed, double scale) {
  std::mt19937 generator(seed);
  std::normal_distribution<float> normal(0, static_cast<float>(scale));
  at::Tensor tensor = at::empty(shape, at::kFloat);
  for (float* value = tensor.data_ptr<float>(); value != tensor.data_ptr<float>() + tensor.numel(); ++value)
    *value = normal(generator);
  return tensor;
}

SafeTensors with_layers(const std::string& layers) {
  SafeTensors network;
  unsigned seed = 0;
  const auto add = [&](const std::string& name, std::int64_t out, std::int64_t in, std::int64_t side) {
    network.tensors[name + ".weight"] = random_tensor({out, in, side, side}, ++seed, 0.4);
    network.tensors[name + ".bias"] = random_tensor({out}, ++seed, 0.2);
  };
  add("a", 4, 3, 3);
  add("b", 5, 4, 5);
  add("c", 3, 5, 1);
  add("aside1", 6, 5, 1);
  add("aside2", 2, 6, 3);
  network.metadata["patina_network"] =
      R"({"format": 1, "name": "small", "mean": [0.5, 0.4, 0.3], "std": [0.2, 0.3, 0.4], "layers": )" +
      layers + "}";
  return network;
}

SafeTensors small_network() {
  return with_layers(R"([{"op": "conv", "weights": "a", "relu": true},
                         {"op": "tap"},
                         {"op": "avg_pool"},
                         {"op": "conv", "weights": "b", "relu": false},
                         {"op": "tap", "weights": ["aside1", "aside2"]},
                         {"op": "max_pool"},
                         {"op": "conv", "weights": "c"},
                         {"op": "tap", "weights": []}])");
}

}  // namespace patina
