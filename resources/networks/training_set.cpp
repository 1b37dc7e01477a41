#include "resources/networks/training_set.h"

#include <ATen/TensorOperators.h>
#include <ATen/core/grad_mode.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/mm.h>
#include <ATen/ops/stack.h>
#include <torch/serialize.h>

#include "engine/summary/gram.h"

namespace patina {

at::Tensor to_unit(const at::Tensor& bytes) { return bytes.to(at::kFloat) / 255; }

at::Tensor relative_distances(const at::Tensor& rows) {
  const at::Tensor products = at::mm(rows, rows.t());
  const at::Tensor squares = products.diagonal(), norms = squares.sqrt();
  const at::Tensor apart = (squares.unsqueeze(0) + squares.unsqueeze(1) - 2 * products).clamp_min(0).sqrt();
  return 2 * apart / (norms.unsqueeze(0) + norms.unsqueeze(1));
}

TrainingSet make_training_set(const std::vector<at::Tensor>& images, const Network& teacher) {
  const at::NoGradGuard no_grad;
  TrainingSet set;
  set.images = (at::stack(images) * 255).round().to(at::kByte);
  const auto count = static_cast<std::int64_t>(images.size());
  const GramMatrices gram(teacher);
  std::vector<at::Tensor> rows;  // of each tap
  for (const SummaryBlock& block : gram.blocks()) rows.push_back(at::empty({count, block.size}, at::kFloat));
  for (std::int64_t i = 0; i < count; ++i) {
    const at::Tensor summary = gram(to_unit(set.images[i]));
    std::int64_t begin = 0;
    for (at::Tensor& tap : rows) {
      tap[i].copy_(summary.narrow(0, begin, tap.size(1)));
      begin += tap.size(1);
    }
  }
  std::vector<at::Tensor> distances;
  for (at::Tensor& tap : rows) distances.push_back(relative_distances(std::exchange(tap, {})));
  set.distances = at::stack(distances);
  return set;
}

void save(const TrainingSet& set, const std::filesystem::path& file) {
  torch::save(std::vector<at::Tensor>{set.images, set.distances}, file.string());
}

TrainingSet load_training_set(const std::filesystem::path& file) {
  std::vector<at::Tensor> tensors;
  torch::load(tensors, file.string());
  return {tensors.at(0), tensors.at(1)};
}

}  // namespace patina
