// The network's steps, each with a backward pass of its own, and what other devices run in their place,
// against the library's operations and their differentiation.
#include "engine/summary/feature_steps.h"

#include <ATen/TensorOperators.h>
#include <ATen/ops/conv2d.h>
#include <ATen/ops/reflection_pad2d.h>
#include <ATen/ops/relu.h>
#include <ATen/ops/stack.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

#include "engine/summary/gram.h"
#include "engine/summary/library_steps.h"
#include "tests/summary/network_files.h"

namespace patina {
namespace {

using Step = std::function<at::Tensor(const at::Tensor&)>;

/// How far two outputs, and two gradients of a weighted sum of them, are apart, over the largest entry.
struct Apart {
  double values, gradients;
};

Apart apart(const Step& once, const Step& again, const at::Tensor& x) {
  const at::Tensor a = x.clone().set_requires_grad(true), b = x.clone().set_requires_grad(true);
  const at::Tensor ya = once(a), yb = again(b);
  EXPECT_EQ(ya.sizes(), yb.sizes());
  const auto relative = [](const at::Tensor& p, const at::Tensor& q) {
    return ((p - q).abs().max() / q.abs().max()).item<double>();
  };
  const at::Tensor weights = random_tensor(ya.sizes().vec(), 9);
  (ya * weights).sum().backward();
  (yb * weights).sum().backward();
  return {relative(ya, yb), relative(a.grad(), b.grad())};
}

/// They are the same to float32's rounding.
void expect_same_step(const Step& once, const Step& again, const at::Tensor& x, const std::string& what) {
  const Apart off = apart(once, again, x);
  EXPECT_LT(off.values, 1e-5) << what;
  EXPECT_LT(off.gradients, 1e-5) << what;
}

TEST(PackedConvolution, EqualsTheLibrarysOfMapsOfAnySizeAndThereIsNoneForBfloat16) {
  const at::Tensor weight = random_tensor({5, 4, 3, 3}, 1), bias = random_tensor({5}, 2);
  for (const bool relu : {true, false})
    for (const std::int64_t padding : {0, 1}) {
      const auto packed = PackedConvolution::make(weight, bias, relu, padding);
      ASSERT_TRUE(packed);
      for (const std::int64_t side : {5, 64, 70}) {
        const at::Tensor x =
            random_tensor({2, 4, side, side + 1}, 3).contiguous(at::MemoryFormat::ChannelsLast);
        const at::Tensor y = at::conv2d(x, weight, bias, 1, padding), expected = relu ? y.relu() : y;
        EXPECT_LT((packed->of(x) - expected).abs().max().item<double>(), 1e-5);
      }
    }
  EXPECT_FALSE(PackedConvolution::make(weight.to(at::kBFloat16), bias.to(at::kBFloat16), true, 1));
}

TEST(FeatureSteps, AConvolutionEqualsTheLibrarysWithItsPaddingAndItsReluApart) {
  for (const std::int64_t kernel : {1, 3, 5})
    for (const auto& [rows, columns] : {std::pair<std::int64_t, std::int64_t>{6, 9}, {12, 12}, {64, 63}})
      for (const bool relu : {true, false})
        for (const bool reflect : {true, false}) {
          const at::Tensor weight = random_tensor({5, 4, kernel, kernel}, 1), bias = random_tensor({5}, 2);
          const FrozenConvolution convolution(weight, bias, relu, reflect);
          const std::int64_t pad = kernel / 2;
          const Step library = [&](const at::Tensor& x) {
            const at::Tensor padded = reflect && pad > 0 ? at::reflection_pad2d(x, {pad, pad, pad, pad}) : x;
            const at::Tensor y = at::conv2d(padded, weight, bias, 1, reflect ? 0 : pad);
            return relu ? at::relu(y) : y;
          };
          const at::Tensor map = random_tensor({1, 4, rows, columns}, 3);
          const std::string what = std::to_string(kernel) + " on " + std::to_string(rows) + " x " +
                                   std::to_string(columns) + (relu ? ", relu" : "") +
                                   (reflect ? ", reflect" : "");
          expect_same_step([&](const at::Tensor& x) { return convolve(convolution, x); }, library, map, what);
          expect_same_step([&](const at::Tensor& x) { return convolve_by_library(convolution, x); }, library,
                           map, "on other devices: " + what);
        }
}

TEST(FeatureSteps, InBfloat16AConvolutionIsOffByItsRoundingAndNoMore) {
  const at::Tensor weight = random_tensor({16, 8, 3, 3}, 1), bias = random_tensor({16}, 2);
  // Without ReLU, so that no entry near zero is on one side of it here and on the other there.
  const FrozenConvolution exact(weight, bias, false, true);
  const FrozenConvolution rounded(weight, bias, false, true, Precision::bfloat16);
  const at::Tensor x = random_tensor({1, 8, 24, 24}, 3);
  try {
    const Apart off = apart([&](const at::Tensor& map) { return convolve(rounded, map); },
                            [&](const at::Tensor& map) { return convolve(exact, map); }, x);
    for (const double error : {off.values, off.gradients}) {
      EXPECT_GT(error, 1e-4) << "8 bits are not 24";
      EXPECT_LT(error, 1e-2) << "each factor is off by 2^-9 at most";
    }
  } catch (const c10::Error&) {
    EXPECT_FALSE(bfloat16_pays());
    GTEST_SKIP() << "the library has no convolution in bfloat16 for this processor";
  }
}

TEST(FeatureSteps, PoolingEqualsThatOfOtherDevicesAtEvenAndOddSizesInPlanesAndWithChannelsLast) {
  for (const auto& [rows, columns] :
       {std::pair<std::int64_t, std::int64_t>{8, 6}, {7, 9}, {2, 3}, {6, 64}, {5, 77}, {4, 90}})
    for (const at::MemoryFormat format : {at::MemoryFormat::Contiguous, at::MemoryFormat::ChannelsLast})
      expect_same_step([&](const at::Tensor& x) { return average_pool(x.contiguous(format)); },
                       [](const at::Tensor& x) { return average_pool_by_library(x); },
                       random_tensor({2, 5, rows, columns}, 4),
                       std::to_string(rows) + " x " + std::to_string(columns));
}

TEST(FeatureSteps, AMapTooSmallToReflectIsRefused) {
  const FrozenConvolution wide(random_tensor({2, 3, 5, 5}, 1), random_tensor({2}, 2), true, true);
  const at::Tensor small = random_tensor({1, 3, 2, 8}, 3);
  EXPECT_THROW(convolve(wide, small), std::invalid_argument);
  EXPECT_THROW(convolve_by_library(wide, small), std::invalid_argument);
}

TEST(FeatureSteps, GramVectorHasTheGradientThatDifferentiatingTheProductGives) {
  const Step plain = [](const at::Tensor& features) {
    const at::Tensor flat = features.reshape({features.size(1), -1});
    const at::Tensor gram = flat.matmul(flat.t()) / static_cast<double>(flat.size(1));
    std::vector<at::Tensor> entries;
    for (std::int64_t i = 0; i < gram.size(0); ++i)
      for (std::int64_t j = i; j < gram.size(0); ++j)
        entries.push_back(gram[i][j] * (i == j ? 1 : std::sqrt(2.0)));
    return at::stack(entries).unsqueeze(0);
  };
  const at::Tensor features = random_tensor({1, 6, 7, 9}, 5);
  expect_same_step([](const at::Tensor& x) { return gram_vector(x); }, plain, features, "rows of channels");
  expect_same_step([](const at::Tensor& x) { return gram_vector(x); }, plain,
                   features.contiguous(at::MemoryFormat::ChannelsLast), "channels last");
}

TEST(FeatureSteps, CovarianceVectorIsTheGramVectorOfCentredFeaturesAndSoIsItsGradient) {
  const Step centred = [](const at::Tensor& features) {
    return gram_vector(features - features.mean({2, 3}, true));
  };
  expect_same_step([](const at::Tensor& x) { return covariance_vector(x); }, centred,
                   random_tensor({2, 6, 7, 9}, 5), "centred");
}

}  // namespace
}  // namespace patina
