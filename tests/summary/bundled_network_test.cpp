// The bundled network: the file, what its summary sees, and whom it agrees with; and what make-network makes.
#include <ATen/TensorOperators.h>
#include <ATen/core/grad_mode.h>
#include <ATen/ops/avg_pool2d.h>
#include <ATen/ops/reflection_pad2d.h>
#include <ATen/ops/roll.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include "engine/image.h"
#include "engine/io/file.h"
#include "engine/io/image_file.h"
#include "engine/summary/image_tensor.h"
#include "engine/summary/network.h"
#include "engine/summary/summary.h"
#include "resources/networks/distilled_vgg.h"
#include "resources/networks/gram_distance.h"
#include "resources/networks/held_out.h"
#include "tests/summary/gradients.h"
#include "tests/summary/network_files.h"

namespace patina {
namespace {

double gram_distance(const Summary& summary, const at::Tensor& a, const at::Tensor& b) {
  const at::NoGradGuard no_grad;
  return gram_distance(summary(a), summary(b), summary.blocks());
}

/// A periodic texture: a sum of waves of many directions and lengths, in one colour.
at::Tensor periodic_texture(std::int64_t side, unsigned seed) {
  const at::Tensor random = random_tensor({60, 3}, seed);
  at::Tensor image = random_tensor({3, side, side}, 0, 0);
  auto pixel = image.accessor<float, 3>();
  const auto number = random.accessor<float, 2>();
  for (int wave = 0; wave < 60; ++wave) {
    const double fx = std::round(20 * number[wave][0]), fy = std::round(20 * number[wave][1]);
    for (std::int64_t row = 0; row < side; ++row)
      for (std::int64_t column = 0; column < side; ++column) {
        const double phase = 2 * std::numbers::pi * (fx * column + fy * row) / side + 9 * number[wave][2];
        for (int c = 0; c < 3; ++c)
          pixel[c][row][column] += static_cast<float>(0.02 * (1 - 0.3 * c) * std::sin(phase));
      }
  }
  return (image + 0.5).clamp(0, 1);
}

at::Tensor blurred(const at::Tensor& image) {
  return at::avg_pool2d(at::reflection_pad2d(image.unsqueeze(0), {1, 1, 1, 1}), {3, 3}, {1, 1}).squeeze(0);
}

std::filesystem::path distilled_weights() {
  return std::filesystem::path(PATINA_SHARED_DIR) / "weights" / "vgg19_distilled_16x.safetensors";
}

class BundledNetwork : public NetworkFiles {};

std::shared_ptr<const Summary> bundled() { return make_summary("gram", {}); }

TEST_F(BundledNetwork, IsTheFileThatTheReadmeDescribesAndSmall) {
  const std::string bytes = read_file(bundled_network());
  const std::filesystem::path readme =
      std::filesystem::path(PATINA_SOURCE_DIR) / "resources/networks/README.md";
  EXPECT_NE(read_file(readme).find(sha256_hex(bytes)), std::string::npos) << sha256_hex(bytes);
  EXPECT_LE(bytes.size(), 2'000'000u);
  EXPECT_EQ(Network::load(bundled_network()).name(), "patina-1");
}

TEST_F(BundledNetwork, HasFewDeadChannelsAndGramMatricesOfOneOrder) {
  const at::NoGradGuard no_grad;
  const std::vector<at::Tensor> images = held_out_renders(/*draws_per_material=*/2, 128).images;
  const Network network = Network::load(bundled_network());
  std::vector<at::Tensor> power(5);  // mean square of each channel, by tap, over all images
  for (const at::Tensor& image : images) {
    const std::vector<at::Tensor> features = network.features(image.unsqueeze(0));
    ASSERT_EQ(features.size(), power.size());
    for (std::size_t tap = 0; tap < power.size(); ++tap) {
      const at::Tensor mine = features[tap].square().mean({0, 2, 3}) / static_cast<double>(images.size());
      power[tap] = power[tap].defined() ? power[tap] + mine : mine;
    }
  }
  for (const at::Tensor& tap : power) {
    EXPECT_LE((tap < 1e-4 * tap.mean()).sum().item<int>(), tap.size(0) / 16) << "dead of " << tap.size(0);
    EXPECT_GT(tap.sum().item<double>(), 0.2);
    EXPECT_LT(tap.sum().item<double>(), 5.0);
  }
}

TEST_F(BundledNetwork, ItsSummarysGradientIsThatOfFiniteDifferences) {
  EXPECT_LT(gradient_error(*bundled(), 64, 3e-4), 0.02);
  EXPECT_LT(gradient_error(*bundled(), 64, 3e-4), 0.7 * gradient_error(*bundled(), 64, 3e-3)) << "kinks";
}

/// Spearman's correlation of two summaries' distances over the pairs of some images.
double rank_correlation(const Summary& a, const Summary& b, const LabelledImages& images) {
  const at::NoGradGuard no_grad;
  std::vector<double> by_a, by_b;
  for (const auto& [i, j] : held_out_pairs(images.materials, 1000, 1)) {
    by_a.push_back(gram_distance(a, images.images[i], images.images[j]));
    by_b.push_back(gram_distance(b, images.images[i], images.images[j]));
  }
  return spearman(by_a, by_b);
}

TEST_F(BundledNetwork, RanksHeldOutRendersAsTheDistilledVggDoes) {
  const std::filesystem::path weights = distilled_weights();
  if (!std::filesystem::exists(weights)) GTEST_SKIP() << "no weights at " << weights;
  const auto vgg = make_summary("gram", file(describe_distilled_vgg(read_safetensors(weights))));
  const LabelledImages images = held_out_renders(/*draws_per_material=*/3, 128);
  EXPECT_GT(rank_correlation(*bundled(), *vgg, images), 0.94);
  EXPECT_LT(rank_correlation(*make_summary("means", {}), *vgg, images), 0.9)
      << "the control: colour is not enough";
}

TEST_F(BundledNetwork, SeesWhatATextureIsAndNotWhereItLies) {
  const auto summary = bundled();
  const at::Tensor texture = periodic_texture(128, 1);
  const double shift = gram_distance(*summary, texture, at::roll(texture, {37, 61}, {1, 2}));
  const double blur = gram_distance(*summary, texture, blurred(texture));
  const double other = gram_distance(*summary, texture, periodic_texture(128, 2));
  EXPECT_LT(shift, 0.05) << "only borders differ";
  EXPECT_GT(blur, 5 * shift);
  EXPECT_GT(blur, 0.1);
  EXPECT_GT(other, 3 * shift);
}

TEST_F(BundledNetwork, TellsContrastDirectionAndColourApartAtEqualBrightness) {
  const auto summary = bundled();
  const at::Tensor texture = periodic_texture(128, 1);
  const at::Tensor mean = texture.mean({1, 2}, /*keepdim=*/true);
  const at::Tensor stretched = periodic_texture(128, 1).slice(1, 0, 64).repeat_interleave(2, 1);
  const double shift = gram_distance(*summary, texture, at::roll(texture, {37, 61}, {1, 2}));
  EXPECT_GT(gram_distance(*summary, texture, mean + 0.7 * (texture - mean)), 3 * shift);
  EXPECT_GT(gram_distance(*summary, texture, stretched), 3 * shift);
  EXPECT_GT(gram_distance(*summary, texture, texture.flip(0)), 3 * shift);
}

/// The first line that a shell command prints; empty if it fails.
std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
  char line[512] = "";
  return pipe && std::fgets(line, sizeof line, pipe.get()) ? line : "";
}

TEST_F(BundledNetwork, AFileCanDescribeADistilledVggWhoseDistanceIsThatOfItsPythonReference) {
  const std::filesystem::path weights = distilled_weights();
  if (!std::filesystem::exists(weights)) GTEST_SKIP() << "no weights at " << weights;
  if (output_of("/usr/bin/python3 -c 'import numpy, PIL; print(1)' 2>/dev/null") != "1\n")
    GTEST_SKIP() << "needs python3-numpy and python3-pil";
  const std::filesystem::path a = folder_ / "a.png", b = folder_ / "b.png";
  for (const auto& [path, seed] : {std::pair(a, 1u), std::pair(b, 2u)}) {
    const at::Tensor texture = periodic_texture(256, seed).permute({1, 2, 0}).contiguous();
    Image image(256, 256, 3);
    std::copy_n(texture.data_ptr<float>(), image.pixels.size(), image.pixels.begin());
    write_image(path, image);
  }
  const std::string line =
      output_of("/usr/bin/python3 " +
                (std::filesystem::path(PATINA_SHARED_DIR) / "tools/appearance_distance.py").string() + " " +
                a.string() + " " + b.string());
  double expected = -1;
  ASSERT_EQ(std::sscanf(line.c_str(), "texture %lf", &expected), 1) << line;
  const auto summary = make_summary("gram", file(describe_distilled_vgg(read_safetensors(weights))));
  EXPECT_NEAR(gram_distance(*summary, to_tensor(read_image(a)), to_tensor(read_image(b))), expected, 1e-3);
}

TEST(Spearman, IsThatOfTheRanksAndKnowsTies) {
  EXPECT_NEAR(spearman({1, 2, 3, 4}, {0.1, 1, 10, 1e9}), 1, 1e-12) << "any rising function";
  EXPECT_NEAR(spearman({1, 2, 3, 4}, {4, 3, 2, 1}), -1, 1e-12);
  EXPECT_NEAR(spearman({1, 2, 3, 4, 5}, {2, 1, 4, 3, 5}), 1 - 6 * 4.0 / (5 * 24), 1e-12);
  EXPECT_NEAR(spearman({1, 2, 2, 3}, {1, 2, 3, 4}), 4.5 / std::sqrt(4.5 * 5), 1e-12);
  EXPECT_TRUE(std::isnan(spearman({1, 1}, {1, 2})));
}

TEST_F(BundledNetwork, DescribingOtherWeightsAsTheDistilledVggIsRefused) {
  EXPECT_NE(user_error([] { describe_distilled_vgg(small_network()); }).find("conv0"), std::string::npos);
}

}  // namespace
}  // namespace patina
