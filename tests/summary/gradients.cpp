#include "tests/summary/gradients.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/dot.h>

#include <cmath>

#include "tests/summary/network_files.h"

namespace patina {
namespace {

double projected(const Summary& summary, const at::Tensor& image, const at::Tensor& weights) {
  return at::dot(summary(image).to(at::kDouble), weights.to(at::kDouble)).item<double>();
}

}  // namespace

at::Tensor random_image(std::int64_t side, unsigned seed) {
  return (random_tensor({3, side, side}, seed, 0.2) + 0.5).clamp(0, 1);
}

double gradient_error(const Summary& summary, std::int64_t side, double step) {
  const at::Tensor image = random_image(side);
  const at::Tensor weights = random_tensor({summary(image).size(0)}, 5);
  const at::Tensor leaf = image.clone().set_requires_grad(true);
  at::dot(summary(leaf), weights).backward();
  double error = 0, scale = 0;
  for (unsigned seed = 10; seed < 18; ++seed) {
    const at::Tensor direction = random_tensor({3, side, side}, seed);
    const double exact = (leaf.grad() * direction).sum().item<double>();
    const double difference = (projected(summary, image + step * direction, weights) -
                               projected(summary, image - step * direction, weights)) /
                              (2 * step);
    error += (exact - difference) * (exact - difference);
    scale += difference * difference;
  }
  return std::sqrt(error / scale);
}

}  // namespace patina
