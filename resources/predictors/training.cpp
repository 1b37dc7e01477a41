#include "resources/predictors/training.h"

#include <ATen/CPUGeneratorImpl.h>
#include <ATen/TensorOperators.h>
#include <ATen/core/grad_mode.h>
#include <ATen/ops/arange.h>
#include <ATen/ops/randn.h>
#include <ATen/ops/randperm.h>
#include <torch/optim/adamw.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace patina {
namespace {

/// An example far from what it was taken for would undo what others taught.
void limit_gradient(const std::vector<at::Tensor>& parameters) {
  constexpr double kLimit = 5;
  double square = 0;
  for (const at::Tensor& p : parameters) square += p.grad().square().sum().item<double>();
  if (square > kLimit * kLimit)
    for (const at::Tensor& p : parameters) p.grad().mul_(kLimit / std::sqrt(square));
}

}  // namespace

void train(DenseStudent& student, const at::Tensor& features, std::int64_t held_back,
           const std::function<at::Tensor(const at::Tensor&, const at::Tensor&)>& loss,
           const DenseTrainingSettings& settings,
           const std::function<void(const DenseTrainingReport&)>& report) {
  const at::Tensor inputs = student.standardised(features);
  const std::int64_t count = features.size(0) - held_back;
  const at::Tensor others = at::arange(count, features.size(0), at::kLong);
  const std::vector<at::Tensor> parameters = student.parameters();
  torch::optim::AdamW adam(parameters,
                           torch::optim::AdamWOptions(settings.rate).weight_decay(settings.decay));
  at::Generator generator = at::detail::createCPUGenerator(settings.seed);
  double best = std::numeric_limits<double>::infinity();
  for (int epoch = 0; epoch < settings.epochs; ++epoch) {
    const double done = static_cast<double>(epoch) / settings.epochs;
    static_cast<torch::optim::AdamWOptions&>(adam.param_groups()[0].options())
        .lr(settings.rate * (0.5 + 0.5 * std::cos(std::numbers::pi * done)));
    const at::Tensor order = at::randperm(count, generator, at::kLong);
    double sum = 0;
    for (std::int64_t first = 0; first < count; first += settings.batch) {
      const at::Tensor chosen = order.narrow(0, first, std::min<std::int64_t>(settings.batch, count - first));
      const at::Tensor clean = inputs.index_select(0, chosen);
      const at::Tensor error =
          loss(student(clean + settings.noise * at::randn(clean.sizes(), generator)), chosen);
      adam.zero_grad();
      error.backward();
      limit_gradient(parameters);
      adam.step();
      sum += error.item<double>() * static_cast<double>(chosen.size(0));
    }
    const at::NoGradGuard no_grad;
    const double judged = loss(student(inputs.index_select(0, others)), others).item<double>();
    report({epoch + 1, sum / static_cast<double>(count), judged, judged < best});
    best = std::min(best, judged);
  }
}

}  // namespace patina
