#include "engine/summary/gram.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/cat.h>
#include <ATen/ops/empty.h>
#include <ATen/ops/empty_like.h>
#include <ATen/ops/mm.h>
#include <ATen/ops/outer.h>
#include <ATen/ops/triu_indices.h>
#include <ATen/ops/where.h>
#include <ATen/ops/zeros.h>
#include <torch/csrc/autograd/custom_function.h>

#include <numbers>

#include "engine/summary/feature_kernel.h"

namespace patina {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

/// The upper triangle of a matrix: where its entries lie, row by row, and their weights.
struct Triangle {
  at::Tensor places, weights;
};

Triangle upper_triangle(std::int64_t channels, at::ScalarType type) {
  const at::Tensor upper = at::triu_indices(channels, channels);
  return {upper[0] * channels + upper[1], at::where(upper[0] == upper[1], 1.0, std::numbers::sqrt2).to(type)};
}

/// Up to so many channels our own products are faster than a BLAS, which is made for matrices that are large
/// both ways (bench-summary).
constexpr std::int64_t kFewChannels = 96;

bool is_small(const at::Tensor& pixels) {
  return pixels.size(1) <= kFewChannels && pixels.scalar_type() == at::kFloat;
}

/// Of [pixels, channels].
at::Tensor gram_matrix(const at::Tensor& pixels) {
  const std::int64_t channels = pixels.size(1);
  if (!is_small(pixels)) return at::mm(pixels.t(), pixels) / static_cast<double>(pixels.size(0));
  const at::Tensor gram = at::empty({channels, channels}, pixels.options());
  features::gram(pixels.data_ptr<float>(), pixels.size(0), channels, gram.data_ptr<float>());
  return gram;
}

at::Tensor product(const at::Tensor& pixels, const at::Tensor& matrix) {
  if (!is_small(pixels)) return at::mm(pixels, matrix);
  const at::Tensor result = at::empty_like(pixels);
  features::times(pixels.data_ptr<float>(), pixels.size(0), pixels.size(1),
                  matrix.contiguous().data_ptr<float>(), result.data_ptr<float>());
  return result;
}

/// gram_vector() with its gradient as one product: with W that by G, F (W + W^T) is that by F.
struct GramVector : torch::autograd::Function<GramVector> {
  static at::Tensor forward(AutogradContext* context, const at::Tensor& features) {
    const std::int64_t channels = features.size(0);
    const at::Tensor pixels =
        features.permute({1, 2, 0}).reshape({-1, channels}).contiguous();  // no copy if channels last
    context->save_for_backward({pixels});
    context->saved_data["rows"] = features.size(1);
    const Triangle triangle = upper_triangle(channels, features.scalar_type());
    return gram_matrix(pixels).reshape({-1}).index_select(0, triangle.places) * triangle.weights;
  }

  static variable_list backward(AutogradContext* context, const variable_list& outputs) {
    const at::Tensor pixels = context->get_saved_variables().front();
    const std::int64_t channels = pixels.size(1), rows = context->saved_data["rows"].toInt();
    const Triangle triangle = upper_triangle(channels, pixels.scalar_type());
    const at::Tensor by_gram = at::zeros({channels * channels}, pixels.options())
                                   .index_copy(0, triangle.places, outputs.front() * triangle.weights)
                                   .view({channels, channels});
    const at::Tensor twice = (by_gram + by_gram.t()) / static_cast<double>(pixels.size(0));
    return {product(pixels, twice).view({rows, -1, channels}).permute({2, 0, 1})};
  }
};

/// What the features' means alone make of a Gram matrix, as gram_vector() has it.
at::Tensor gram_of_means(const at::Tensor& features) {
  const at::Tensor means = features.mean({1, 2});
  const Triangle triangle = upper_triangle(features.size(0), features.scalar_type());
  return at::outer(means, means).reshape({-1}).index_select(0, triangle.places) * triangle.weights;
}

}  // namespace

at::Tensor gram_vector(const at::Tensor& features) { return GramVector::apply(features); }

at::Tensor covariance_vector(const at::Tensor& features) {
  return gram_vector(features) - gram_of_means(features);
}

at::Tensor GramMatrices::operator()(const at::Tensor& image) const {
  std::vector<at::Tensor> grams, covariances;
  for (const at::Tensor& features : network_.features(image)) {
    if (about_ == About::mean) {
      covariances.push_back(covariance_vector(features));
      continue;
    }
    grams.push_back(gram_vector(features));
    if (about_ == About::both) covariances.push_back(grams.back() - gram_of_means(features));
  }
  grams.insert(grams.end(), covariances.begin(), covariances.end());
  return at::cat(grams);
}

std::vector<SummaryBlock> GramMatrices::blocks() const {
  std::vector<SummaryBlock> blocks;
  const int views = about_ == About::both ? 2 : 1;
  const auto add = [&](const std::string& name) {
    int level = 0;
    for (const std::int64_t channels : network_.feature_channels())
      blocks.push_back(
          {name + " " + std::to_string(++level), channels * (channels + 1) / 2, ErrorScale::relative, views});
  };
  if (about_ != About::mean) add("gram");
  if (about_ != About::zero) add("covariances");
  return blocks;
}

}  // namespace patina
