// The bundled network as a statistic of textures, and the two files that make-network makes.
#include <ATen/TensorOperators.h>
#include <ATen/core/grad_mode.h>
#include <ATen/ops/avg_pool2d.h>
#include <ATen/ops/from_blob.h>
#include <ATen/ops/reflection_pad2d.h>
#include <ATen/ops/roll.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include "engine/image.h"
#include "engine/io/image_file.h"
#include "engine/summary/network.h"
#include "engine/summary/summary.h"
#include "resources/networks/bundled_design.h"
#include "resources/networks/distilled_vgg.h"
#include "resources/networks/gram_distance.h"
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

class BundledNetwork : public NetworkFiles {
 protected:
  std::shared_ptr<const Summary> bundled() const { return make_summary("gram", file(bundled_design())); }
};

TEST_F(BundledNetwork, IsTheOneThatTheProgramMakes) {
  const SafeTensors made = bundled_design(), shipped = read_safetensors(bundled_network());
  EXPECT_EQ(made.metadata, shipped.metadata);
  ASSERT_EQ(made.tensors.size(), shipped.tensors.size());
  for (const auto& [name, tensor] : made.tensors) {
    ASSERT_TRUE(shipped.tensors.contains(name)) << name;
    ASSERT_EQ(shipped.tensors.at(name).sizes(), tensor.sizes()) << name;
    EXPECT_TRUE(shipped.tensors.at(name).allclose(tensor, 1e-6, 1e-7)) << name;
  }
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

at::Tensor to_tensor(const Image& image) {
  return at::from_blob(const_cast<float*>(image.pixels.data()), {image.height, image.width, 3})
      .permute({2, 0, 1})
      .contiguous();
}

TEST_F(BundledNetwork, AFileCanDescribeADistilledVggWhoseDistanceIsThatOfItsPythonReference) {
  const std::filesystem::path shared = PATINA_SHARED_DIR;
  const std::filesystem::path weights = shared / "weights" / "vgg19_distilled_16x.safetensors";
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
      output_of("/usr/bin/python3 " + (shared / "tools/appearance_distance.py").string() + " " + a.string() +
                " " + b.string());
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
